#pragma once

#include <cstddef>

namespace viscard {

// exp(-x) of whole arrays, at a few cycles per value. The relative error is below 4e-16 up to
// kDecayGone. Above it exp(-x) is below 2e-35 and is returned as 0.
inline constexpr double kDecayGone = 80.0;

// Where bin averages are evaluated: the mean time of each bin and the moments that the average of
// an exponential needs (fit/samples/log_bins.h). weight multiplies the result.
struct DecayPlaces {
  const double* time_s = nullptr;  // ascending
  const double* weight = nullptr;
  // <d^2>/2, <d^3>/6, <d^4>/24 with d = t - mean; nullptr if bins are single samples.
  const double* half_m2 = nullptr;
  const double* sixth_m3 = nullptr;
  const double* part_m4 = nullptr;
  std::size_t count = 0;
};

// value = weight <exp(-t/tau)>, slope = d value / d ln tau (nullptr: not computed), rate = 1/tau.
void decay_column(const DecayPlaces& at, double rate_1_s, double* value, double* slope);

// series -= modulus exp(-rate t); times ascending.
void subtract_decay(const double* time_s, std::size_t count, double rate_1_s, double modulus,
                    double* series);

// The same, and keeps the exponentials up to where they are above zero. Returns their number.
std::size_t subtract_and_keep_decay(const double* time_s, std::size_t count, double rate_1_s,
                                    double modulus, double* series, double* decay);

// sum a b and sum a b t over the first samples.
struct DecayProducts {
  double plain = 0.0, with_time = 0.0;
};
DecayProducts decay_products(const double* series, const double* decay, const double* time_s,
                             std::size_t count);

}  // namespace viscard
