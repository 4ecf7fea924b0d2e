#pragma once

#include <vector>

#include "fit/fit_data.h"
#include "fit/fit_result.h"
#include "fit/order_choice.h"
#include "fit/order_path.h"
#include "fit/uncertainty.h"

namespace viscard {

// What every kind of fit does after its model stands: path of orders, choice, noise, covariance.
struct SpectralFit {
  std::vector<SpectralState> path;
  OrderScores scores;
  SpectralState state;           // the chosen one, polished
  double variance = 1.0;         // of a weighted residual
  double inflation = 1.0;
  Eigen::VectorXd residual;      // weighted, of the chosen order
};

// What the rows stand for. blocks: see ChoiceInput. Rows that are not averages have no hidden part.
struct RowInfo {
  double n_samples = 0.0;
  double chi_square_hidden = 0.0;   // weighted sum of squares within averages
  std::vector<int> blocks;
  bool rows_are_samples = true;     // consecutive rows are consecutive samples
};

SpectralFit fit_spectrum(const SpectralModel& model, const RowInfo& rows, const FitOptions& options);

// Fills everything of a result that follows from the fit alone: parameters, intervals, orders, noise.
void fill_result(const SpectralModel& model, const SpectralFit& fit,
                 const SeriesFromState& series_from_state, FitResult& result);

// Block numbers for cross-validation: contiguous runs of rows, at least `shortest` long, whose times
// cover at least a share 10^(1/10) of the time since `zero_s`.
std::vector<int> log_time_blocks(const std::vector<double>& time_s, double zero_s, std::size_t shortest);

}  // namespace viscard
