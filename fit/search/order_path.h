#pragma once

#include "fit/curves/spectral_model.h"
#include "fit/search/separable.h"

#include <vector>

namespace viscard {

struct OrderPathOptions {
  int max_terms = 40;
  double grid_per_decade = 8.0;  // of the non-negative start spectrum
  RefineOptions refine{.max_iterations = 100, .tolerance = 1e-7, .unseen_variances = 1e-3};
};

// The best fits found with 0, 1, 2 ... terms, without starting values (fit/search/README.md,
// "Search"). If moduli may have either sign, only the upward pass is used. The result ascends in
// n_terms(). Orders that the data cannot support (a modulus stays at zero) are missing at the top.
std::vector<SpectralState> order_path(const SpectralModel& model, const OrderPathOptions& options);

// Drops orders whose residual is not lower than that of a smaller order.
void drop_useless_orders(std::vector<SpectralState>& path);

// Adds one term to a fit: tries it at the times of the grid, keeps the best one and refines.
SpectralState with_one_more_term(const SpectralModel& model, const SpectralState& state,
                                 const OrderPathOptions& options);

// Steps to the next order, ranked before any search by the exact update of the linear problem.

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
