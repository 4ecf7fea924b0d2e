#pragma once

#include "fit/curves/spectral_model.h"

#include <Eigen/Core>

namespace viscard {

// A SpectralModel at one choice of times and nuisances with the coefficients that are best there:
// what variable projection needs to know of it (Golub & Pereyra, SIAM J. Numer. Anal. 10 (1973)
// 413), with the Jacobian of Kaufman, BIT 15 (1975) 49.
struct Projection {
  Eigen::VectorXd coefficients;
  double rss = 0.0;          // weighted; infinite where the model is not finite
  Eigen::MatrixXd normal;    // J^T J by p
  Eigen::VectorXd gradient;  // J^T r
};

// The non-linear parameters as the searches see them: p = ln tau, then nuisances divided by their
// scale; and back.
Eigen::VectorXd search_parameters(const SpectralModel& model, const Eigen::VectorXd& ln_tau,
                                  const Eigen::VectorXd& nuisance);
Eigen::VectorXd nuisance_from(const SpectralModel& model, const Eigen::VectorXd& p);

// Derivative of the model by p at fixed coefficients.
Eigen::MatrixXd nonlinear_slopes(const SpectralModel& model, const ModelColumns& columns,
                                 const Eigen::VectorXd& coefficients);

// By normal equations with one step of iterative refinement, which is as good as QR while columns
// are no nearer to each other than 1e-5 of their length; by QR where they are. The gradient is
// formed from the residual itself and does not lose digits either way.
Projection project(const SpectralModel& model, const Eigen::VectorXd& p);

// The coefficients alone, with their sum of squares; by normal equations or QR alike.
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
