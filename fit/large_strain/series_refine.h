#pragma once

#include "fit/large_strain/hyperelastic_search.h"

#include <vector>

namespace viscard {

std::vector<double> times_of(const std::vector<RubberTerm>& terms);

// The best of few starts near `start`, which has terms.
HyperelasticPoint refined_series(HyperelasticForm form, const LargeStrainRows& rows,
                                 const HyperelasticPoint& start);

// Range of the relaxation times that the rows can show: a third of the shortest step to three times the
// longest test.
struct TimeRange {
  double low_s = 0.0, high_s = 0.0;
};
TimeRange time_range(const LargeStrainRows& rows);

// Derivative of the rows' model by moduli, shapes, g and ln tau at a point with terms.
Eigen::MatrixXd series_jacobian(HyperelasticForm form, LargeStrainRows rows,
                                const HyperelasticPoint& point);

}  // namespace viscard
