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

}  // namespace

bool is_evenly_sampled(std::span<const double> time_s) {
  if (time_s.size() < kLeastRecord) return false;
  const StepRange steps = step_range(time_s);
  return steps.shortest > 0.0 && steps.longest < 10.0 * steps.shortest;
}

std::vector<std::size_t> isolated_spikes(std::span<const double> time_s,
                                         std::span<const double> values) {
  std::vector<std::size_t> spikes;
  if (!is_evenly_sampled(time_s)) return spikes;
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
