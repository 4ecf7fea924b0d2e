#pragma once

#include <vector>

#include "fit/fit_result.h"
#include "fit/separable.h"

namespace viscard {

// Scores of every order of a path and the choice among them   (fit/README.md, sect. 4).
struct OrderScores {
  std::vector<OrderRow> rows;  // rss is the weighted one here; one is marked as chosen
  std::size_t chosen = 0;      // position in the path
};

// n_samples: before averaging; inflation: variance factor for autocorrelation, so that
// n_samples/inflation independent values were seen. blocks: for each row the number of its block in
// cross-validation. chi_square_added: what averaging has hidden of the weighted sum of squares.
struct ChoiceInput {
  double n_samples = 0.0;
  double inflation = 1.0;
  double chi_square_added = 0.0;
  std::vector<int> blocks;
};
OrderScores choose_order(const SpectralModel& model, const std::vector<SpectralState>& path,
                         const ChoiceInput& input);

// Weighted squared error of predicting each block from a fit to all others, by one linearised step from
// the full fit (exact for a linear model): e_b = (1 - H_bb)^-1 r_b.
std::vector<double> left_out_errors(const SpectralModel& model, const SpectralState& state,
                                    const std::vector<int>& blocks);

}  // namespace viscard
