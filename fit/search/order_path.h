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

// The best fits found with 0, 1, 2 ... terms, without starting values. The search starts from a
// non-negative spectrum on a dense grid of times, merges its neighbouring peaks and refines them.
// Downward pass: at each step it removes the term, or merges the pair, that costs least, and
// refines the others. Upward pass: it adds a term to each fit and keeps the result if it is better
// than the known fit of that order. Then it repeats the downward pass from every order that
// improved. If moduli may have either sign, only the upward pass is used. The result ascends in
// n_terms(). Orders that the data cannot support (a modulus stays at zero) are missing at the top.
std::vector<SpectralState> order_path(const SpectralModel& model, const OrderPathOptions& options);

// Drops orders whose residual is not lower than that of a smaller order.
void drop_useless_orders(std::vector<SpectralState>& path);

// Adds one term to a fit: tries it at the times of the grid, keeps the best one and refines.
SpectralState with_one_more_term(const SpectralModel& model, const SpectralState& state,
                                 const OrderPathOptions& options);

}  // namespace viscard
