#pragma once

#include "fit/search/order_row.h"
#include "fit/search/separable.h"

#include <vector>

namespace viscard {

// Scores of all orders and the choice among them by fit/search/README.md, "Choice of the order".
struct OrderScores {
  std::vector<OrderRow> rows;  // one is marked as chosen
  std::size_t chosen = 0;      // index in the path
  // Higher orders describe the data much better, but have a time at the end of the record's range.
  bool wants_faster = false;
  bool wants_slower = false;
  // For the BIC of other laws: number of independent values, and the sum of squares below which
  // only the rounding of the data is left.
  double n_effective = 1.0, least_rss = 0.0;
};

// n_samples: before averaging.
// inflation: variance factor for autocorrelation; n_samples/inflation values count as independent.
// rss: weighted residual sum of squares of each order over all samples.
// blocks: index of the cross-validation block of each row.
struct ChoiceInput {
  double n_samples = 0.0;
  double inflation = 1.0;
  std::vector<double> rss;
  std::vector<int> blocks;
};
// The scores of a fit with p parameters, without cross-validation. n_samples, n_effective, least_rss: as above.
OrderRow scored_order(int n_terms, double p, double rss, double n_samples,
                      const OrderScores& scores);
OrderScores choose_order(const SpectralModel& model, const std::vector<SpectralState>& path,
                         const ChoiceInput& input);

// False if a time lies at the end of its range: the order needs more than the record can show.
bool is_within_range(const SpectralModel& model, const SpectralState& state);

// Prediction of a block of rows from a fit to all other rows, by one linearised step from the full
// fit (exact for a linear model): e_b = (1 - H_bb)^-1 r_b. A block that alone determines some
// combination of parameters cannot be predicted by any fit; its plain residual is used.
struct LeftOut {
  double squared_error = 0.0;  // weighted
  bool is_predictable = true;
};
std::vector<LeftOut> left_out_errors(const SpectralModel& model, const SpectralState& state,
                                     const std::vector<int>& blocks);

}  // namespace viscard
