#pragma once

#include "fit/curves/spectral_model.h"
#include "fit/search/separable.h"

#include <vector>

namespace viscard {

struct OrderPathOptions {
  int max_terms = 40;
  double grid_per_decade = 8.0;  // of the non-negative start
  RefineOptions refine{.max_iterations = 100, .tolerance = 1e-7, .unseen_variances = 1e-3};
};

// The best fits found with 0, 1, 2 ... terms, from no starting values. First a non-negative
// spectrum on a dense grid of times, whose neighbouring peaks are merged; refined; then down: at
// each step the term whose loss, or the pair whose merging, costs least goes, and the rest is
// refined. Afterwards upwards: where adding a term to the next smaller fit finds a better optimum,
// it is taken; and once more down from those. With moduli of either sign only the way up is open.
// The result is indexed by position, ascending in n_terms(); orders that the data cannot carry (a
// modulus stays at zero) are missing at the top.
std::vector<SpectralState> order_path(const SpectralModel& model, const OrderPathOptions& options);

// Adds one term to a fit: tries it at times on the grid, keeps the best, refines.
SpectralState with_one_more_term(const SpectralModel& model, const SpectralState& state,
                                 const OrderPathOptions& options);

}  // namespace viscard
