#pragma once

#include "fit/search/spectral_state.h"

#include <Eigen/Core>

#include <limits>
#include <vector>

namespace viscard {

// Coefficients that are best at given times and nuisances; moduli not negative unless the model
// says.
SpectralState solve_coefficients(const SpectralModel& model, const Eigen::VectorXd& ln_tau,
                                 const Eigen::VectorXd& nuisance);

// Least squares over times and nuisances within their bounds, the coefficients solved for at every
// step: variable projection, Golub & Pereyra, SIAM J. Numer. Anal. 10 (1973) 413, with the Jacobian
// of Kaufman, BIT 15 (1975) 49, and the trust region of Ceres.
struct RefineOptions {
  int max_iterations = 200;
  double tolerance = 1e-12;  // relative change of the residual sum of squares
  // quick_search() also ends when a step gains less than this many sample_variance() of the model.
  double unseen_variances = 0.0;
  Eigen::Index held = -1;  // number of the time that quick_search() keeps as it is
  // quick_search() gives up on a fit that will not come below this sum of squares.
  double target = std::numeric_limits<double>::infinity();
};
SpectralState refine(const SpectralModel& model, const SpectralState& start,
                     const RefineOptions& options = {});

// A few Gauss-Newton steps in all parameters together, for the last digits; keeps the start where a
// step would leave the bounds or make the fit worse.
SpectralState polish(const SpectralModel& model, const SpectralState& start);

// Derivative of the (weighted) model by all parameters, in the order common, moduli, ln tau,
// nuisance.
Eigen::MatrixXd full_jacobian(const SpectralModel& model, const SpectralState& state);

}  // namespace viscard
