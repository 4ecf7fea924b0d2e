#include "fit/spikes.h"

#include "fit/noise_model.h"
#include "fit/sample_passes.h"

#include <algorithm>
#include <cmath>

namespace viscard {
namespace {

constexpr std::size_t kLeastRecord = 200;

bool is_even(std::span<const double> time_s) {
  const StepRange steps = step_range(time_s);
  return steps.shortest > 0.0 && steps.longest < 10.0 * steps.shortest;
}

// Of stretches across the record; a few thousand differences tell a median well enough.
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
  std::sort(sigmas.begin(), sigmas.end());
  return sigmas[kStretches / 2];
}

}  // namespace

std::vector<std::size_t> isolated_spikes(std::span<const double> time_s,
                                         std::span<const double> values) {
  std::vector<std::size_t> spikes;
  if (values.size() < kLeastRecord || !is_even(time_s)) return spikes;
  const double sigma = noise_of(values);
  if (!(sigma > 0.0)) return spikes;
  const double far = 8.0 * std::sqrt(1.5) * sigma;  // variance of e is 1.5 sigma^2
  for (const std::size_t i : far_from_neighbours(values, far)) {
    const double e = std::abs(values[i] - 0.5 * (values[i - 1] + values[i + 1]));
    if (e >= 2.0 * std::abs(values[i + 1] - values[i - 1])) spikes.push_back(i);
  }
  return spikes;
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
