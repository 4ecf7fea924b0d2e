#pragma once

#include "fit/intervals/fit_result.h"
#include "fit/intervals/uncertainty.h"
#include "fit/search/separable.h"

#include <vector>

namespace viscard {

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

}  // namespace viscard
