#pragma once

#include "fit/large_strain/damage_rows.h"

#include <vector>

namespace viscard {

// The readings of each test at which its strain is as large as never before. Throws std::runtime_error if
// there are fewer than 3 in all, or fewer than 3 others, which show the damage.
std::vector<LargeStrainTest> first_loading_of(const std::vector<LargeStrainTest>& tests);

// Bounds of r.
inline constexpr double kLeastR = 1.0 + 1e-6, kMostR = 1e3;

// The best law with damage, from the law of the first loading in units of the rows. With the law held, r
// follows by linear least squares on a grid of m and beta; the best few points are refined in all
// parameters together (Ceres). Unloading from maxima within 10 % of energy is from one maximum: beta is
// then held at 0, because only m + beta W_m counts. A constant that ends at 0 is held there.
HyperelasticPoint best_damaged_point(HyperelasticForm form, const DamageRows& rows,
                                     const HyperelasticPoint& first_loading);

}  // namespace viscard
