#pragma once

#include "fit/curves/spectral_model.h"
#include "fit/search/separable.h"

#include <Eigen/Core>

#include <vector>

namespace viscard {

// Steps from one order to the next, judged before any search by the exact update of the linear
// part.

Eigen::VectorXd without(const Eigen::VectorXd& values, Eigen::Index leave_out);

// Times of all ways to have one term fewer, dropping one or merging two neighbours at their mean
// time, cheapest in the sum of squares first.
std::vector<Eigen::VectorXd> reductions(const SpectralModel& model, const SpectralState& state);

// Of columns offered beside those present: product with the residual, and squared length, both
// outside the columns in use. product^2/length is what one would take off the sum of squares, the
// others following freely.
struct Offers {
  Eigen::VectorXd product, length;
};
Offers offers_of(const SpectralModel& model, const Eigen::MatrixXd& present,
                 const Eigen::MatrixXd& offered, const std::vector<bool>& is_free);

}  // namespace viscard
