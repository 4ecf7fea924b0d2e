#pragma once

#include "fit/intervals/uncertainty.h"
#include "fit/samples/fit_data.h"
#include "fit/search/order_choice.h"
#include "fit/search/order_path.h"

#include <vector>

namespace viscard {

// The spectrum that was fitted to a model: the path of orders, the choice, noise and covariance.
struct SpectralFit {
  FitOptions options;
  std::vector<SpectralState> path;
  OrderScores scores;
  SpectralState state;    // the chosen one, polished
  double rss = 0.0;       // weighted, over all samples
  double variance = 1.0;  // of one weighted sample
  Autoregression noise;
  Eigen::MatrixXd covariance;       // of all parameters of the state
  std::vector<MaterialFlag> notes;  // constraints that were kept
};

}  // namespace viscard
