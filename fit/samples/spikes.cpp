#include "fit/samples/spikes.h"

#include "fit/samples/median.h"
#include "fit/samples/noise_model.h"
#include "fit/samples/sample_passes.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace viscard {
namespace {

constexpr std::size_t kLeastRecord = 200;

// Noise from several stretches of the record; a few thousand differences suffice for the median.
double noise_of(std::span<const double> values) {
  constexpr std::size_t kStretches = 16;
  constexpr std::size_t kLength = 128;
  if (values.size() <= kStretches * kLength) {
    return sigma_from_differences({values.begin(), values.end()});
  }
  std::vector<double> sigmas;
  for (std::size_t k = 0; k < kStretches; ++k) {
    const auto begin = values.begin() + static_cast<std::ptrdiff_t>((values.size() - kLength) * k /
                                                                    (kStretches - 1));
    sigmas.push_back(sigma_from_differences({begin, begin + kLength}));
  }
  return median(std::move(sigmas));
}

// Range without the highest and lowest half per cent.
double usual_range(std::span<const double> values) {
  std::vector<double> sorted(values.begin(), values.end());
  const auto cut = static_cast<std::ptrdiff_t>(sorted.size() / 200);
  std::nth_element(sorted.begin(), sorted.begin() + cut, sorted.end());
  const double low = sorted[static_cast<std::size_t>(cut)];
  std::nth_element(sorted.begin(), sorted.end() - 1 - cut, sorted.end());
  return sorted[sorted.size() - 1 - static_cast<std::size_t>(cut)] - low;
}

// Judges a run of rows between two neighbours; at an end of the record both are the same row.
struct JumpTest {
  std::span<const double> force_N, depth_m;
  double force_range_N, depth_range_m;

  bool is_jump(std::size_t begin, std::size_t end) const {
    constexpr double kFar = 0.05, kBack = 0.2, kFollows = 0.25;
    const std::size_t before = begin > 0 ? begin - 1 : end;
    const std::size_t after = end < depth_m.size() ? end : before;
    const double gap_m = before != after ? std::abs(depth_m[after] - depth_m[before])
                         : begin == 0    ? std::abs(depth_m[end + 1] - depth_m[end])
                                         : std::abs(depth_m[begin - 1] - depth_m[begin - 2]);
    for (std::size_t i = begin; i < end; ++i) {
      const double from_m = depth_m[i] - depth_m[before], to_m = depth_m[i] - depth_m[after];
      const double far_m = std::min(std::abs(from_m), std::abs(to_m));
      if (from_m * to_m <= 0.0 || far_m < kFar * depth_range_m || gap_m > kBack * far_m)
        return false;
      const double follows_N = std::abs(force_N[i] - 0.5 * (force_N[before] + force_N[after]));
      const double share = std::min(1.0, far_m / depth_range_m);
      if (follows_N > kFollows * share * force_range_N) return false;
    }
    return true;
  }
};

}  // namespace

std::vector<std::size_t> depth_jumps(std::span<const double> force_N,
                                     std::span<const double> depth_m) {
  constexpr std::size_t kFewest = 20, kLongest = 3;
  std::vector<std::size_t> rows;
  const std::size_t n = depth_m.size();
  if (n < kFewest) return rows;
  const JumpTest test{force_N, depth_m, usual_range(force_N), usual_range(depth_m)};
  const double far_m = 0.05 * test.depth_range_m;
  for (std::size_t begin = 0; begin < n; ++begin) {
    // A jump begins where the depth changes at once; the first row has no row before it.
    if (begin > 0 && !(std::abs(depth_m[begin] - depth_m[begin - 1]) > far_m)) continue;
    for (std::size_t end = begin + 1; end <= std::min(n, begin + kLongest); ++end) {
      if (!test.is_jump(begin, end)) continue;
      for (std::size_t i = begin; i < end; ++i) rows.push_back(i);
      begin = end - 1;
      break;
    }
  }
  return rows;
}

bool is_evenly_sampled(const StepRange& steps_s, std::size_t count) {
  return count >= kLeastRecord && steps_s.shortest > 0.0 &&
         steps_s.longest < 10.0 * steps_s.shortest;
}

std::vector<std::size_t> isolated_spikes(std::span<const double> time_s,
                                         std::span<const double> values) {
  return isolated_spikes(step_range(time_s), values);
}

std::vector<std::size_t> isolated_spikes(const StepRange& steps_s, std::span<const double> values) {
  std::vector<std::size_t> spikes;
  if (!is_evenly_sampled(steps_s, values.size())) return spikes;
  const double sigma = noise_of(values);
  if (!(sigma > 0.0)) return spikes;
  const double far = 8.0 * std::sqrt(1.5) * sigma;  // the variance of e below is 1.5 sigma^2
  for (const std::size_t i : far_from_neighbours(values, far)) {
    const double e = std::abs(values[i] - 0.5 * (values[i - 1] + values[i + 1]));
    if (e >= 2.0 * std::abs(values[i + 1] - values[i - 1])) spikes.push_back(i);
  }
  return spikes;
}

std::vector<std::size_t> outlying_samples(std::span<const double> residual, double largest_value) {
  constexpr std::size_t kFewest = 1000, kEnough = 8192, kLongestGroup = 3;
  constexpr double kFar = 5.5, kLeastShare = 1e-6, kMost = 0.03;
  const std::size_t n = residual.size();
  std::vector<std::size_t> outliers;
  if (n < kFewest) return outliers;
  std::vector<double> sizes;
  for (std::size_t i = 0; i < n; i += 1 + n / kEnough) sizes.push_back(std::abs(residual[i]));
  const double far =
      std::max(kFar * median(std::move(sizes)) / kMedianOfNormal, kLeastShare * largest_value);
  for (std::size_t i = 1; i + 1 < n; ++i) {
    if (!(std::abs(residual[i]) > far) || std::abs(residual[i - 1]) > far) continue;
    std::size_t end = i + 1;
    while (end < n && std::abs(residual[end]) > far) ++end;
    if (end < n && end - i <= kLongestGroup) {
      for (std::size_t k = i; k < end; ++k) outliers.push_back(k);
    }
    i = end;
  }
  if (static_cast<double>(outliers.size()) > kMost * static_cast<double>(n)) outliers.clear();
  return outliers;
}

std::vector<double> without_rows(std::span<const double> column,
                                 const std::vector<std::size_t>& rows) {
  std::vector<double> rest;
  rest.reserve(column.size() - rows.size());
  auto next = rows.begin();
  for (std::size_t i = 0; i < column.size(); ++i) {
    if (next != rows.end() && *next == i) {
      ++next;
    } else {
      rest.push_back(column[i]);
    }
  }
  return rest;
}

}  // namespace viscard
