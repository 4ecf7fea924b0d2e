#pragma once

#include "fit/curves/spectral_model.h"
#include "fit/search/separable.h"

#include <Eigen/Core>

#include <vector>

namespace viscard {

// Steps from one order to the next, ranked before any search by the exact update of the linear
// least-squares problem.

// The vector without one entry.
Eigen::VectorXd without(const Eigen::VectorXd& values, Eigen::Index leave_out);

// Relaxation times of all candidates with one term fewer (one term removed, or two neighbours
// merged at their mean time), sorted by the resulting sum of squares.
std::vector<Eigen::VectorXd> reductions(const SpectralModel& model, const SpectralState& state);

// For each column offered beside the present ones: its product with the residual and its squared
// length, both after projection onto the orthogonal complement of the columns in use.
// product^2/length is the decrease of the sum of squares if the column is added and the other
// coefficients are solved again.
struct Offers {
  Eigen::VectorXd product, length;
};
Offers offers_of(const SpectralModel& model, const Eigen::MatrixXd& present,
                 const Eigen::MatrixXd& offered, const std::vector<bool>& is_free);

}  // namespace viscard
