#pragma once

#include <span>
#include <vector>

namespace viscard {

// Noise of one reading, sigma^2 = floor^2 + (share value)^2: an absolute part (amplifier, converter)
// and one in proportion to the value (gain, slip).
struct ReadingNoise {
  double floor = 0.0;  // in the unit of the values
  double share = 0.0;  // of the value, a pure number

  // The smallest and the largest values that are many differ by more than chance and half.
  bool grows = false;

  // Standard deviation and variance of a reading of this value, in the unit of the values and its square.
  double sigma(double value) const;
  double variance(double value) const { return floor * floor + share * share * value * value; }
};

// The noise between neighbours: third differences, whose median neither spikes nor a smooth curve
// changes, in classes of the size of the value (a factor of two each). Both parts are those of least
// squares of the variances of the classes, relative to the variances themselves, and not negative.
// Zero for fewer than five values.
ReadingNoise reading_noise(std::span<const double> values);

// The same from deviations from known values (residuals of a fit). Equal lengths.
ReadingNoise noise_of_deviations(std::span<const double> values,
                                 std::span<const double> deviations);

// Standard deviation of each value over the root mean square of all (weights: how many readings each
// value is the mean of; empty: one). The level of a value is the mean of its neighbours, so that the noise
// of a value does not change its own weight.
std::vector<double> relative_sigmas(const ReadingNoise& noise, std::span<const double> values,
                                    std::span<const double> weights = {});

// The standard deviation of the noise about row `at`, from the third differences of up to 30 rows on
// either side of [begin, end), which are not used.
double noise_beside(std::span<const double> values, std::size_t begin, std::size_t end);

}  // namespace viscard
