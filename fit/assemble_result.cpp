#include "fit/assemble_result.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "fit/noise_model.h"

namespace viscard {
namespace {

using Index = Eigen::Index;

Eigen::VectorXd residual_of(const SpectralModel& model, const SpectralState& state) {
  return model.data() -
         model.columns(state.ln_tau, state.nuisance, false).values * state.coefficients;
}

// The path as far as the wish for one order needs it, and that order alone if it was wished for.
std::vector<SpectralState> wished_path(const SpectralModel& model, const FitOptions& options) {
  OrderPathOptions path_options;
  path_options.max_terms = options.n_terms.value_or(options.max_terms);
  std::vector<SpectralState> path = order_path(model, path_options);
  if (path.empty()) {
    throw std::runtime_error("no model fits these data: every modulus comes out zero. Check the sign "
                             "of the fitted column");
  }
  return path;
}

double inflation_of(const Eigen::VectorXd& residual, const RowInfo& rows, double sigma_squared) {
  if (rows.rows_are_samples) return integrated_autocorrelation(residual);
  // Averages: their scatter beyond what the scatter within them explains.
  return std::max(1.0, residual.squaredNorm() / static_cast<double>(residual.size()) / sigma_squared);
}

}  // namespace

SpectralFit fit_spectrum(const SpectralModel& model, const RowInfo& rows, const FitOptions& options) {
  SpectralFit fit;
  fit.path = wished_path(model, options);
  const SpectralState& fullest = fit.path.back();
  const auto n_parameters = [&](const SpectralState& state) {
    return static_cast<double>(model.n_common() + 2 * state.n_terms() + model.n_nuisances());
  };
  const auto variance_of = [&](const SpectralState& state) {
    return (state.rss + rows.chi_square_hidden) /
           std::max(1.0, rows.n_samples - n_parameters(state));
  };
  ChoiceInput choice{rows.n_samples, 1.0, rows.chi_square_hidden, rows.blocks};
  if (!options.white_noise) {
    choice.inflation = inflation_of(residual_of(model, fullest), rows, variance_of(fullest));
  }
  fit.scores = choose_order(model, fit.path, choice);
  if (options.n_terms) {
    for (OrderRow& row : fit.scores.rows) row.is_chosen = false;
    fit.scores.chosen = fit.path.size() - 1;
    fit.scores.rows[fit.scores.chosen].is_chosen = true;
  }
  fit.state = polish(model, fit.path[fit.scores.chosen]);
  fit.residual = residual_of(model, fit.state);
  fit.variance = variance_of(fit.state);
  fit.inflation = options.white_noise ? 1.0 : inflation_of(fit.residual, rows, fit.variance);
  return fit;
}

void fill_result(const SpectralModel& model, const SpectralFit& fit,
                 const SeriesFromState& series_from_state, FitResult& result) {
  const Eigen::MatrixXd covariance =
      parameter_covariance(model, fit.state, fit.variance * fit.inflation);
  fill_parameters(model, fit.state, covariance, series_from_state, result);
  result.orders = fit.scores.rows;
  result.noise.inflation = fit.inflation;
  result.is_converged = fit.state.is_converged;
}

std::vector<int> log_time_blocks(const std::vector<double>& time_s, double zero_s,
                                 std::size_t shortest) {
  std::vector<int> blocks;
  int block = 0;
  std::size_t begin = 0;
  constexpr double kRatio = 1.2589254117941673;  // 10^(1/10)
  for (std::size_t i = 0; i < time_s.size(); ++i) {
    const bool is_long = i >= begin + shortest;
    const double since_begin = std::abs(time_s[begin] - zero_s);
    if (is_long && std::abs(time_s[i] - zero_s) >= kRatio * since_begin) {
      ++block;
      begin = i;
    }
    blocks.push_back(block);
  }
  return blocks;
}

}  // namespace viscard
