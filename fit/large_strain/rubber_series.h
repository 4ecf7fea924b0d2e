#pragma once

#include "fit/large_strain/hyperelastic_search.h"

#include <optional>
#include <vector>

namespace viscard {

// The law with each number of terms, from none to the largest, refined in all parameters together.
//   Start: law and spectrum in turns, the law by its own search with the spectrum held, the spectrum by
//   non-negative least squares on 4 times a decade with the law held. Neighbours are merged.
//   Then downwards: each term removed or merged with its neighbour, the best few refined.
// n_terms: exactly this number, otherwise up to most_terms.
std::vector<HyperelasticPoint> series_path(HyperelasticForm form, const LargeStrainRows& rows,
                                           std::optional<int> n_terms, int most_terms);

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
