#pragma once

#include "fit/intervals/fit_result.h"
#include "fit/intervals/uncertainty.h"
#include "fit/samples/fit_data.h"
#include "fit/search/order_choice.h"
#include "fit/search/order_path.h"

#include <vector>

namespace viscard {

// What every kind of fit does after its model stands: path of orders, choice, noise, covariance.
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

// blocks: number of each row's block for cross-validation (log_time_blocks).
SpectralFit fit_spectrum(const SpectralModel& model, const std::vector<int>& blocks,
                         const FitOptions& options);

// Fills everything of a result that follows from the fit alone: parameters, intervals (with the
// doubt about the order, profiles and bootstrap as the options ask), orders, noise.
void fill_result(const SpectralModel& model, const SpectralFit& fit,
                 const SeriesFromState& series_from_state, FitResult& result);

// The series where the state's parameters are the material's own: E_inf first (a liquid has none),
// then the moduli. The model must outlive it.
SeriesFromState relaxation_series_of(const SpectralModel& model, bool is_liquid);

// Block numbers for cross-validation: contiguous runs of rows that end when they cover a tenth of a
// decade of the time since `zero_s`, but not before `shortest` rows nor after a fiftieth of all.
std::vector<int> log_time_blocks(const std::vector<double>& time_s, double zero_s,
                                 std::size_t shortest);

}  // namespace viscard
