#pragma once

#include "fit/search/order_row.h"
#include "fit/search/separable.h"

#include <vector>

namespace viscard {

// Scores of every order of a path and the choice among them   (fit/README.md, sect. 4): the fewest
// terms whose left-out blocks are predicted as well as by the best order, within one standard error
// of the paired difference, and never more than BIC asks for. An order with a time at the end of
// the range is not eligible; one with a time above a third of the record gives way to a smaller one
// without, unless BIC (by 6) or three standard errors speak for it.
struct OrderScores {
  std::vector<OrderRow> rows;  // one is marked as chosen
  std::size_t chosen = 0;      // position in the path
  // Higher orders describe the data much better, but with a time at the end of what the record can
  // show.
  bool wants_faster = false;
  bool wants_slower = false;
};

// n_samples: before averaging; inflation: variance factor for autocorrelation, so that
// n_samples/inflation independent values were seen. rss: of each order over all samples, weighted.
// blocks: for each row the number of its block in cross-validation.
struct ChoiceInput {
  double n_samples = 0.0;
  double inflation = 1.0;
  std::vector<double> rss;
  std::vector<int> blocks;
};
OrderScores choose_order(const SpectralModel& model, const std::vector<SpectralState>& path,
                         const ChoiceInput& input);

// A time at the end of its range is not a time: the order asks for more than the record can show.
bool is_within_range(const SpectralModel& model, const SpectralState& state);

// How a block of rows is predicted by a fit to all others, by one linearised step from the full fit
// (exact for a linear model): e_b = (1 - H_bb)^-1 r_b. A block that alone holds what is known of
// some combination of parameters cannot be predicted by any fit; it counts with its plain residual.
struct LeftOut {
  double squared_error = 0.0;  // weighted
  double squared_residual = 0.0;
  bool is_predictable = true;
};
std::vector<LeftOut> left_out_errors(const SpectralModel& model, const SpectralState& state,
                                     const std::vector<int>& blocks);

}  // namespace viscard
