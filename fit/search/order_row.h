#pragma once

namespace viscard {

// One row of the table of orders tried.
struct OrderRow {
  int n_terms = 0;
  double rss = 0.0;  // all samples, unweighted, unit of the fitted column squared
  double aicc = 0.0;
  double bic = 0.0;
  double cv = 0.0;  // mean squared prediction error of left-out blocks over that of the noise
  bool is_chosen = false;
};

}  // namespace viscard
