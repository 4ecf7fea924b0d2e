#pragma once

#include "fit/intervals/fit_result.h"
#include "fit/intervals/uncertainty.h"
#include "fit/search/separable.h"

#include <vector>

namespace viscard {

// Profile likelihood of E_inf and of every relaxation time: the parameter is held at values around
// its estimate, all others are fitted again, and what the sum of squares rises by, over the
// variance of the noise, is compared with 3.84 (Venzon & Moolgavkar, Appl. Statist. 37 (1988) 87).
// Asymmetric where the covariance is not to be trusted, and aware of bounds: an interval that
// reaches one ends there. For noise with memory the rise is divided by the ratio of the parameter's
// variance with and without it.
//   covariance, white: of the parameters of the state, with the memory of the noise and without.
//   series_from_state: curves are drawn over the material's own E_inf and ln tau_i, which must be
// as many as the state's. With a frame in series E_inf is a function of the stage's alone and its
// curve is exact; for a time it is the stage's that is held.
std::vector<ProfileCurve> profile_likelihoods(const SpectralModel& model,
                                              const SpectralState& state, double variance,
                                              const Eigen::MatrixXd& covariance,
                                              const Eigen::MatrixXd& white,
                                              const SeriesFromState& series_from_state);

}  // namespace viscard
