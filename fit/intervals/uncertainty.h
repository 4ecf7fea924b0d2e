#pragma once

#include "fit/intervals/fit_result.h"
#include "fit/samples/noise_model.h"
#include "fit/search/separable.h"
#include "models/material/prony_series.h"

#include <Eigen/Core>

#include <functional>

namespace viscard {

// Covariance of all parameters of a state, in full_jacobian()'s order. White noise of that
// variance: variance * (J^T J)^-1. Noise with memory: variance * (J^T J)^-1 J^T C J (J^T J)^-1 with
// the autocorrelation C that the autoregression implies between rows, averages or not; exact for
// least squares with such noise, for fast terms and slow ones alike. By QR of scaled columns.
// Parameters that the data do not reach (a zero column, a modulus at zero) get an infinite
// variance.
Eigen::MatrixXd parameter_covariance(const SpectralModel& model, const SpectralState& state,
                                     double variance, const Autoregression& noise = {});

// What a state means for the material: its series, terms in the state's order.
using SeriesFromState = std::function<PronySeries(const SpectralState&)>;

// Fills terms, E0, E_inf, their standard errors, 95 % intervals and covariance of a result from a
// state and the covariance of its parameters. Relaxation times get symmetric intervals of their
// logarithm; g_i follows from the joint covariance. First-order propagation through
// series_from_state.
void fill_parameters(const SpectralModel& model, const SpectralState& state,
                     const Eigen::MatrixXd& covariance, const SeriesFromState& series_from_state,
                     FitResult& result);

}  // namespace viscard
