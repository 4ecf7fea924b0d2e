#pragma once

namespace viscard {

// One row of the table of orders tried.
struct OrderRow {
  int n_terms = 0;
  double rss = 0.0;  // over all samples, unweighted, in the squared unit of the fitted column
  double aicc = 0.0;
  double bic = 0.0;
  double cv = 0.0;  // mean squared prediction error of left-out blocks over noise variance
  bool is_chosen = false;
};

}  // namespace viscard
