#pragma once

#include "fit/curves/spectral_model.h"

#include <Eigen/Core>

#include <limits>

namespace viscard {

// Best coefficients at given times and nuisances. Moduli are negative only if the model allows it.
SpectralState solve_coefficients(const SpectralModel& model, const Eigen::VectorXd& ln_tau,
                                 const Eigen::VectorXd& nuisance);

// Least squares over times and nuisances within their bounds, with the coefficients solved at every
// step: variable projection, Golub & Pereyra, SIAM J. Numer. Anal. 10 (1973) 413, with the Jacobian
// of Kaufman, BIT 15 (1975) 49, and the trust region of Ceres.
struct RefineOptions {
  int max_iterations = 200;
  double tolerance = 1e-12;  // relative change of the residual sum of squares
  // quick_search() also ends if a step gains less than this times the model's sample_variance().
  double unseen_variances = 0.0;
  Eigen::Index held = -1;  // index of a time that quick_search() keeps fixed; -1: none
  // quick_search() gives up a fit whose sum of squares will probably stay above this value.
  double target = std::numeric_limits<double>::infinity();
};
SpectralState refine(const SpectralModel& model, const SpectralState& start,
                     const RefineOptions& options = {});

// Fast replacement for refine() in the many fits of an order path: Levenberg-Marquardt within the
// bounds of the parameters on normal equations (projection.h), with the damping of Nielsen,
// IMM-REP-1999-05, Techn. Univ. Denmark. A problem of two terms takes some tens of microseconds;
// setting up Ceres alone takes longer. refine() and polish() compute the last digits.
SpectralState quick_search(const SpectralModel& model, const SpectralState& start,
                           const RefineOptions& options);

// Derivative of the (weighted) model by all parameters, ordered common, moduli, ln tau, nuisance.
Eigen::MatrixXd full_jacobian(const SpectralModel& model, const SpectralState& state);

}  // namespace viscard
