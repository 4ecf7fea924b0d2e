#pragma once

#include "fit/curves/spectral_model.h"

#include <Eigen/Core>

namespace viscard {

// A SpectralModel at given times and nuisances with its best coefficients, and the quantities that
// variable projection needs (Golub & Pereyra, SIAM J. Numer. Anal. 10 (1973) 413), with the
// Jacobian of Kaufman, BIT 15 (1975) 49.
struct Projection {
  Eigen::VectorXd coefficients;
  double rss = 0.0;          // weighted; infinite if the model is not finite
  Eigen::MatrixXd normal;    // J^T J, derivatives by p
  Eigen::VectorXd gradient;  // J^T r
};

// Non-linear parameters p of searches: ln tau, then nuisances over their scale; and the way back.
Eigen::VectorXd search_parameters(const SpectralModel& model, const Eigen::VectorXd& ln_tau,
                                  const Eigen::VectorXd& nuisance);
Eigen::VectorXd nuisance_from(const SpectralModel& model, const Eigen::VectorXd& p);

// Derivative of the model by p at fixed coefficients.
Eigen::MatrixXd nonlinear_slopes(const SpectralModel& model, const ModelColumns& columns,
                                 const Eigen::VectorXd& coefficients);

// Uses the normal equations with one step of iterative refinement, which is as accurate as QR
// unless a column is closer than 1e-5 (relative) to the span of the others; then QR is used. The
// gradient is computed from the residual itself and keeps its digits in both cases.
Projection project(const SpectralModel& model, const Eigen::VectorXd& p);

// Only the coefficients and their residual sum of squares, likewise by normal equations or QR.
struct Coefficients {
  Eigen::VectorXd x;
  double rss = 0.0;
};
Coefficients best_coefficients(const SpectralModel& model, const Eigen::MatrixXd& values,
                               const std::vector<bool>& is_free);

// Bounds of p.
struct Box {
  Eigen::VectorXd low, high;
};
Box search_box(const SpectralModel& model, Eigen::Index n_terms);

}  // namespace viscard
