#pragma once

#include "fit/intervals/fit_result.h"
#include "fit/samples/noise_model.h"
#include "fit/search/separable.h"
#include "models/material/prony_series.h"

#include <Eigen/Core>

#include <functional>

namespace viscard {

// Covariance of all parameters of a state, in the order of full_jacobian(). White noise of the
// given variance: variance * (J^T J)^-1. Autocorrelated noise: variance * (J^T J)^-1 J^T C J (J^T
// J)^-1, where C is the autocorrelation between rows (averages or samples) that the autoregression
// implies. This is exact for least squares with such noise, for fast and slow terms. Computed by QR
// of scaled columns. Parameters that do not influence the data (a zero column, a modulus at zero)
// get an infinite variance.
Eigen::MatrixXd parameter_covariance(const SpectralModel& model, const SpectralState& state,
                                     double variance, const Autoregression& noise = {});

// The material's series for a state, terms in the order of the state.
using SeriesFromState = std::function<PronySeries(const SpectralState&)>;

// Fills terms, E0, E_inf, their standard errors, 95 % intervals and covariance of a result from a
// state and the covariance of its parameters, by first-order propagation through series_from_state.
// Intervals of relaxation times are symmetric in the logarithm; the errors of g_i use the joint
// covariance.
void fill_parameters(const SpectralModel& model, const SpectralState& state,
                     const Eigen::MatrixXd& covariance, const SeriesFromState& series_from_state,
                     FitResult& result);

}  // namespace viscard
