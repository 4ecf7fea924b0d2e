#include "fit/samples/decay.h"

#include "models/maths/wide_loops.h"

#include <algorithm>
#include <bit>
#include <cstdint>

namespace viscard {
namespace {

// exp(-x) for 0 <= x < 700 without branches or tables, so that the compiler can vectorise it: -x =
// n ln 2 + r with ln 2 in two parts (Cody & Waite, Software Manual for the Elementary Functions
// (1980), ch. 6), Taylor's series to r^13, and n added to the exponent bits.
inline double decay(double x) {
  constexpr double kPerLn2 = 1.4426950408889634;
  constexpr double kRound = 6755399441055744.0;  // 1.5 * 2^52: adding it leaves an integer
  constexpr double kLn2High = 6.93147180369123816490e-01;
  constexpr double kLn2Low = 1.90821492927058770002e-10;
  const double shifted = kRound - x * kPerLn2;
  const double n = shifted - kRound;
  const double r = (-x - n * kLn2High) - n * kLn2Low;
  const double rr = r * r;
  // Even and odd powers separately, so that the two sums do not wait for each other.
  const double even =
      1.0 + rr * (1.0 / 2 +
                  rr * (1.0 / 24 +
                        rr * (1.0 / 720 +
                              rr * (1.0 / 40320 + rr * (1.0 / 3628800 + rr * (1.0 / 479001600))))));
  const double odd =
      1.0 +
      rr * (1.0 / 6 +
            rr * (1.0 / 120 +
                  rr * (1.0 / 5040 +
                        rr * (1.0 / 362880 + rr * (1.0 / 39916800 + rr * (1.0 / 6227020800.0))))));
  constexpr std::uint64_t kBias = 1023;
  const std::uint64_t exponent = (std::bit_cast<std::uint64_t>(shifted) + kBias) << 52U;
  return (even + r * odd) * std::bit_cast<double>(exponent);
}

// Inlined into its caller, so that it is compiled for the caller's processor.
template <bool kWithSlope>
[[gnu::always_inline]] inline void average_decay(const DecayPlaces& at, double u,
                                                 double* __restrict value,
                                                 double* __restrict slope) {
  const double uu = u * u;
  const double* __restrict time_s = at.time_s;
  const double* __restrict weight = at.weight;
  const double* __restrict m2 = at.half_m2;
  const double* __restrict m3 = at.sixth_m3;
  const double* __restrict m4 = at.part_m4;
  for (std::size_t i = 0; i < at.count; ++i) {
    const double x = u * time_s[i];
    const double e = weight[i] * decay(x);
    const double series = 1.0 + uu * (m2[i] - u * (m3[i] - u * m4[i]));
    value[i] = e * series;
    if constexpr (kWithSlope) {
      slope[i] = e * (x * series - uu * (2.0 * m2[i] - u * (3.0 * m3[i] - u * (4.0 * m4[i]))));
    }
  }
}

}  // namespace

// The loops. Each handles the places where the decay is above zero.
VISCARD_WIDE_LOOP void decay_of_samples(const double* __restrict time_s,
                                        const double* __restrict weight, std::size_t count,
                                        double rate_1_s, double* __restrict value) {
  for (std::size_t i = 0; i < count; ++i) value[i] = weight[i] * decay(rate_1_s * time_s[i]);
}

VISCARD_WIDE_LOOP void decay_of_bins(const DecayPlaces& at, double rate_1_s,
                                     double* __restrict value, double* __restrict slope) {
  average_decay<true>(at, rate_1_s, value, slope);
}

VISCARD_WIDE_LOOP void decay_of_bins(const DecayPlaces& at, double rate_1_s,
                                     double* __restrict value) {
  average_decay<false>(at, rate_1_s, value, nullptr);
}

VISCARD_WIDE_LOOP void subtract_samples(const double* __restrict time_s, std::size_t count,
                                        double rate_1_s, double modulus,
                                        double* __restrict series) {
  for (std::size_t i = 0; i < count; ++i) series[i] -= modulus * decay(rate_1_s * time_s[i]);
}

VISCARD_WIDE_LOOP void subtract_and_keep(const double* __restrict time_s, std::size_t count,
                                         double rate_1_s, double modulus, double* __restrict series,
                                         double* __restrict kept) {
  for (std::size_t i = 0; i < count; ++i) {
    kept[i] = decay(rate_1_s * time_s[i]);
    series[i] -= modulus * kept[i];
  }
}

// Eight sums of each kind side by side, so that one addition does not wait for the other.
VISCARD_WIDE_LOOP void products_of_samples(const double* __restrict series,
                                           const double* __restrict kept,
                                           const double* __restrict time_s, std::size_t count,
                                           double* __restrict sums) {
  double plain[8] = {}, with_time[8] = {};
  std::size_t i = 0;
  for (; i + 8 <= count; i += 8) {
    for (std::size_t k = 0; k < 8; ++k) {
      const double product = series[i + k] * kept[i + k];
      plain[k] += product;
      with_time[k] += product * time_s[i + k];
    }
  }
  for (; i < count; ++i) {
    plain[0] += series[i] * kept[i];
    with_time[0] += series[i] * kept[i] * time_s[i];
  }
  for (std::size_t k = 0; k < 8; ++k) {
    sums[0] += plain[k];
    sums[1] += with_time[k];
  }
}

void decay_column(const DecayPlaces& at, double rate_1_s, double* value, double* slope) {
  const double* end = at.time_s + at.count;
  DecayPlaces left = at;
  left.count = static_cast<std::size_t>(
      std::partition_point(at.time_s, end, [&](double t) { return rate_1_s * t < kDecayGone; }) -
      at.time_s);
  if (at.half_m2 == nullptr) {
    decay_of_samples(at.time_s, at.weight, left.count, rate_1_s, value);
    for (std::size_t i = 0; slope != nullptr && i < left.count; ++i) {
      slope[i] = rate_1_s * at.time_s[i] * value[i];
    }
  } else if (slope != nullptr) {
    decay_of_bins(left, rate_1_s, value, slope);
  } else {
    decay_of_bins(left, rate_1_s, value);
  }
  std::fill(value + left.count, value + at.count, 0.0);
  if (slope != nullptr) std::fill(slope + left.count, slope + at.count, 0.0);
}

void subtract_decay(const double* time_s, std::size_t count, double rate_1_s, double modulus,
                    double* series) {
  const double* end = std::partition_point(time_s, time_s + count,
                                           [&](double t) { return rate_1_s * t < kDecayGone; });
  subtract_samples(time_s, static_cast<std::size_t>(end - time_s), rate_1_s, modulus, series);
}

std::size_t subtract_and_keep_decay(const double* time_s, std::size_t count, double rate_1_s,
                                    double modulus, double* series, double* decay) {
  const double* end = std::partition_point(time_s, time_s + count,
                                           [&](double t) { return rate_1_s * t < kDecayGone; });
  const auto above_zero = static_cast<std::size_t>(end - time_s);
  subtract_and_keep(time_s, above_zero, rate_1_s, modulus, series, decay);
  return above_zero;
}

DecayProducts decay_products(const double* series, const double* decay, const double* time_s,
                             std::size_t count) {
  double sums[2] = {};
  products_of_samples(series, decay, time_s, count, sums);
  return {sums[0], sums[1]};
}

}  // namespace viscard
