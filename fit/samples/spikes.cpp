#include "fit/samples/spikes.h"

#include "fit/samples/reading_noise.h"
#include "fit/samples/sample_passes.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace viscard {
namespace {

constexpr std::size_t kLeastRecord = 200;

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
  const ReadingNoise noise = reading_noise(values);
  const double far = 8.0 * std::sqrt(1.5);  // the variance of e below is 1.5 sigma^2
  const auto least = [](std::span<const double> all) {
    double smallest = std::abs(all.front());
    for (const double value : all) smallest = std::min(smallest, std::abs(value));
    return smallest;
  };
  // Noise that grows with the value makes large readings scatter more.
  const double least_sigma = noise.share > 0.0 ? noise.sigma(least(values)) : noise.floor;
  if (!(noise.floor > 0.0 || noise.share > 0.0)) return spikes;
  for (const std::size_t i : far_from_neighbours(values, far * least_sigma)) {
    const double beside = 0.5 * (values[i - 1] + values[i + 1]);
    const double e = std::abs(values[i] - beside);
    if (e > far * noise.sigma(beside) && e >= 2.0 * std::abs(values[i + 1] - values[i - 1])) {
      spikes.push_back(i);
    }
  }
  return spikes;
}

std::vector<std::size_t> outlying_samples(std::span<const double> residual,
                                          std::span<const double> values, double largest_value) {
  constexpr std::size_t kFewest = 1000, kLongestGroup = 3;
  constexpr double kFar = 5.5, kLeastShare = 1e-6, kMost = 0.03;
  const std::size_t n = residual.size();
  std::vector<std::size_t> outliers;
  if (n < kFewest) return outliers;
  const ReadingNoise noise = noise_of_deviations(values, residual);
  const auto is_far = [&](std::size_t i) {
    // By the value that the fit expects there.
    const double far =
        std::max(kFar * noise.sigma(values[i] - residual[i]), kLeastShare * largest_value);
    return std::abs(residual[i]) > far;
  };
  for (std::size_t i = 1; i + 1 < n; ++i) {
    if (!is_far(i) || is_far(i - 1)) continue;
    std::size_t end = i + 1;
    while (end < n && is_far(end)) ++end;
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
