#include "fit/samples/sample_passes.h"

#include "models/maths/wide_loops.h"

#include <algorithm>
#include <cmath>

namespace viscard {
namespace {

using Flags = long long __attribute__((vector_size(kLanes * sizeof(double))));

}  // namespace

VISCARD_WIDE_LOOP double sum_of_samples(const double* values, std::size_t count) {
  Lanes sums[4] = {};
  std::size_t i = 0;
  for (; i + 4 * kLanes <= count; i += 4 * kLanes) {
    for (std::size_t k = 0; k < 4; ++k) sums[k] += lanes_at(values + i + k * kLanes)->lanes;
  }
  double sum = total(sums[0]) + total(sums[1]) + total(sums[2]) + total(sums[3]);
  for (; i < count; ++i) sum += values[i];
  return sum;
}

VISCARD_WIDE_LOOP bool all_samples_finite(const double* values, std::size_t count) {
  // A finite number times 0 is 0; any other value makes the sum NaN.
  Lanes sums[4] = {};
  std::size_t i = 0;
  for (; i + 4 * kLanes <= count; i += 4 * kLanes) {
    for (std::size_t k = 0; k < 4; ++k) sums[k] += 0.0 * lanes_at(values + i + k * kLanes)->lanes;
  }
  double sum = total(sums[0]) + total(sums[1]) + total(sums[2]) + total(sums[3]);
  for (; i < count; ++i) sum += 0.0 * values[i];
  return sum == 0.0;
}

VISCARD_WIDE_LOOP StepRange steps_of_samples(const double* times, std::size_t count) {
  double low = times[1] - times[0], high = low;
  constexpr std::size_t kChains = 4;  // comparisons that do not wait for each other
  const Lanes first = {low, low, low, low};
  Lanes lows[kChains] = {first, first, first, first}, highs[kChains] = {first, first, first, first};
  std::size_t i = 1;
  for (; i + kChains * kLanes <= count; i += kChains * kLanes) {
    for (std::size_t k = 0; k < kChains; ++k) {
      const double* at = times + i + k * kLanes;
      const Lanes step = lanes_at(at)->lanes - lanes_at(at - 1)->lanes;
      lows[k] = step < lows[k] ? step : lows[k];
      highs[k] = step > highs[k] ? step : highs[k];
    }
  }
  for (; i < count; ++i) {
    low = std::min(low, times[i] - times[i - 1]);
    high = std::max(high, times[i] - times[i - 1]);
  }
  for (std::size_t k = 0; k < kChains * kLanes; ++k) {
    low = std::min(low, lows[k / kLanes][k % kLanes]);
    high = std::max(high, highs[k / kLanes][k % kLanes]);
  }
  return {low, high};
}

// True if any sample of a stretch is far from the mean of its two neighbours, which must exist.
VISCARD_WIDE_LOOP bool has_far_sample(const double* values, std::size_t count, double far) {
  Flags any = {};
  std::size_t i = 0;
  for (; i + kLanes <= count; i += kLanes) {
    const Lanes from = lanes_at(values + i)->lanes -
                       0.5 * (lanes_at(values + i - 1)->lanes + lanes_at(values + i + 1)->lanes);
    any |= (from > far) | (from < -far);
  }
  bool is_any = (any[0] | any[1] | any[2] | any[3]) != 0;
  for (; i < count; ++i) {
    is_any |= std::abs(values[i] - 0.5 * (values[i - 1] + values[i + 1])) > far;
  }
  return is_any;
}

VISCARD_WIDE_LOOP void add_powers(const double* times, const double* values, std::size_t count,
                                  double centre, double level, PowerSums& out) {
  Lanes s[11] = {};
  std::size_t i = 0;
  for (; i + kLanes <= count; i += kLanes) {
    const Lanes d = lanes_at(times + i)->lanes - centre;
    const Lanes y = lanes_at(values + i)->lanes - level;
    const Lanes dd = d * d, ddd = dd * d;
    s[0] += d;
    s[1] += dd;
    s[2] += ddd;
    s[3] += dd * dd;
    s[4] += dd * ddd;
    s[5] += ddd * ddd;
    s[6] += y;
    s[7] += y * d;
    s[8] += y * dd;
    s[9] += y * ddd;
    s[10] += y * y;
  }
  double sums[11];
  for (std::size_t k = 0; k < 11; ++k) sums[k] = total(s[k]);
  for (; i < count; ++i) {
    const double d = times[i] - centre, y = values[i] - level;
    const double terms[11] = {
        d,     d * d,     d * d * d,     d * d * d * d, d * d * d * d * d, d * d * d * d * d * d, y,
        y * d, y * d * d, y * d * d * d, y * y};
    for (std::size_t k = 0; k < 11; ++k) sums[k] += terms[k];
  }
  out = {sums[0], sums[1], sums[2], sums[3], sums[4], sums[5],
         sums[6], sums[7], sums[8], sums[9], sums[10]};
}

bool all_finite(std::span<const double> values) {
  return all_samples_finite(values.data(), values.size());
}

double sum_of(std::span<const double> values) {
  return sum_of_samples(values.data(), values.size());
}

StepRange step_range(std::span<const double> times) {
  return times.size() < 2 ? StepRange{} : steps_of_samples(times.data(), times.size());
}

std::vector<std::size_t> far_from_neighbours(std::span<const double> values, double far) {
  constexpr std::size_t kBlock = 256;
  std::vector<std::size_t> found;
  for (std::size_t begin = 1; begin + 1 < values.size(); begin += kBlock) {
    const std::size_t end = std::min(begin + kBlock, values.size() - 1);
    if (!has_far_sample(values.data() + begin, end - begin, far)) continue;
    for (std::size_t i = begin; i < end; ++i) {
      if (std::abs(values[i] - 0.5 * (values[i - 1] + values[i + 1])) > far) found.push_back(i);
    }
  }
  return found;
}

PowerSums power_sums(std::span<const double> times, std::span<const double> values, double centre,
                     double level) {
  PowerSums sums;
  add_powers(times.data(), values.data(), times.size(), centre, level, sums);
  return sums;
}

}  // namespace viscard
