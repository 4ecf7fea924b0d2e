#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace viscard {

// Operations on whole records, each in one pass at memory speed.

bool all_finite(std::span<const double> values);
double sum_of(std::span<const double> values);

// Smallest and largest difference of neighbours; both 0 for fewer than two times. Times are sorted
// if the smallest difference is not negative.
struct StepRange {
  double shortest = 0.0, longest = 0.0;
};
StepRange step_range(std::span<const double> times);

// Indices of the inner samples that differ from the mean of their neighbours by more than `far`.
std::vector<std::size_t> far_from_neighbours(std::span<const double> values, double far);

// Sums over a stretch of samples of d^k, y d^k and y^2, with d = t - centre, y = value - level.
struct PowerSums {
  double d1 = 0.0, d2 = 0.0, d3 = 0.0, d4 = 0.0, d5 = 0.0, d6 = 0.0;
  double y = 0.0, yd1 = 0.0, yd2 = 0.0, yd3 = 0.0, yy = 0.0;
};
PowerSums power_sums(std::span<const double> times, std::span<const double> values, double centre,
                     double level);

}  // namespace viscard
