#pragma once

#include "fit/intervals/fit_result.h"
#include "fit/samples/noise_model.h"
#include "fit/search/separable.h"
#include "models/material/prony_series.h"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace viscard {

// Covariance of all parameters of a state, in the order of full_jacobian(). White noise of the
// given variance: variance * (J^T J)^-1. Autocorrelated noise: variance * (J^T J)^-1 J^T C J (J^T
// J)^-1, where C is the autocorrelation between rows (averages or samples) that the autoregression
// implies. This is exact for least squares with such noise, for fast and slow terms. Computed by QR
// of scaled columns. Parameters that do not influence the data (a zero column, a modulus at zero)
// get an infinite variance.
//   row_scale: standard deviation of each row over that of all (level_noise.h), empty if all are alike.
Eigen::MatrixXd parameter_covariance(const SpectralModel& model, const SpectralState& state,
                                     double variance, const Autoregression& noise = {},
                                     const Eigen::VectorXd& row_scale = {});

// The same from the derivatives of the rows by any parameters, those by the model's nuisances last.
Eigen::MatrixXd covariance_from_jacobian(const SpectralModel& model, Eigen::MatrixXd jacobian,
                                         double variance, const Autoregression& noise,
                                         const Eigen::VectorXd& row_scale = {});

// C x for every column x. C correlates the rows; a row is sqrt(n) times a mean of the samples from
// begins[row] on.
Eigen::MatrixXd correlated_rows(const Eigen::MatrixXd& x, const std::vector<std::size_t>& begins,
                                const Autoregression& noise);

// Each row times its standard deviation over that of all; the rows themselves if row_scale is empty.
Eigen::MatrixXd scaled_rows(const Eigen::MatrixXd& rows, const Eigen::VectorXd& row_scale);

// Widens variances for the part of the noise that is slower than the autoregression: each by its
// share of the inflation, so that fast terms change little. Correlations stay. white: the variances
// for white noise.
void add_slow_part(Eigen::MatrixXd& covariance, const Eigen::VectorXd& white,
                   const Autoregression& noise);

// The material's series for a state, terms in the order of the state.
using SeriesFromState = std::function<PronySeries(const SpectralState&)>;

// The series of a state that may be none of a material, such as one within the uncertainty of the optimum; nothing
// if a modulus that may not be negative is, or if a frame in series is softer than the whole.
std::optional<PronySeries> possible_series(const SpectralModel& model, const SpectralState& state,
                                           const SeriesFromState& series_from_state);

// Fills terms, E0, E_inf, their standard errors, 95 % intervals and covariance of a result from a
// state and the covariance of its parameters, by first-order propagation through series_from_state.
// Intervals of relaxation times are symmetric in ln tau; errors of g_i use the joint covariance.
void fill_parameters(const SpectralModel& model, const SpectralState& state,
                     const Eigen::MatrixXd& covariance, const SeriesFromState& series_from_state,
                     FitResult& result);

// 95 % quantile of chi-square with one degree of freedom: the rise that ends an interval.
inline constexpr double kChiSquare95 = 3.841458820694124;

// Profile likelihood of E_inf and of every relaxation time. The parameter is held at values around
// its estimate, all others are fitted again, and the rise of the sum of squares over the variance
// of the noise is compared with 3.84 (Venzon & Moolgavkar, Appl. Statist. 37 (1988) 87). The
// intervals are asymmetric where a quadratic approximation fails, and they end at a bound that they
// reach. For autocorrelated noise the rise is divided by the ratio of the parameter's variance with
// and without autocorrelation.
//   covariance, white: of the parameters of the state, with and without autocorrelation.
//   series_from_state: gives the material's own E_inf and ln tau_i, the abscissa of the curves;
//   the numbers of terms must agree.
// With a frame in series E_inf is a function of the stage's E_inf alone, so its curve is exact. For
// a time, the stage's time is held.
std::vector<ProfileCurve> profile_likelihoods(const SpectralModel& model,
                                              const SpectralState& state, double variance,
                                              const Eigen::MatrixXd& covariance,
                                              const Eigen::MatrixXd& white,
                                              const SeriesFromState& series_from_state);

// Replaces the 95 % intervals of a result by percentiles of refits to the fitted curve plus
// randomly drawn blocks of its own residuals: the circular moving-block bootstrap (Kuensch, Ann.
// Statist. 17 (1989) 1217), whose blocks preserve the autocorrelation of the noise. The block
// length is that of Politis & White, Econometric Rev. 23 (2004) 53, for an autoregression of first
// order with the given inflation. The seed is fixed: the same data give the same intervals.
struct BootstrapOptions {
  int n_resamples = 200;
  double inflation = 1.0;
  std::uint64_t seed = 1;
  std::function<void(double fraction)> progress;  // the share that is done; may be empty
};
void bootstrap_intervals(const SpectralModel& model, const SpectralState& state,
                         const SeriesFromState& series_from_state, const BootstrapOptions& options,
                         FitResult& result);

}  // namespace viscard
