#pragma once

#include "fit/assembly/constraints.h"
#include "fit/search/separable.h"

#include <Eigen/Core>

namespace viscard {

// theta = (E_inf, E_i | E0, g_i; ln tau_i; the others), and the state that follows from it.
class Parametrisation {
 public:
  Parametrisation(const SpectralModel& model, Eigen::Index n_terms, bool by_shares);

  // Index of a parameter in theta.
  Eigen::Index position(const ParameterName& name) const;
  Eigen::Index size() const;
  const SpectralModel& model() const { return model_; }

  Eigen::VectorXd theta_of(const SpectralState& state) const;
  SpectralState state_of(const Eigen::VectorXd& theta) const;
  // d(coefficients, ln tau, nuisance)/d theta.
  Eigen::MatrixXd slopes(const Eigen::VectorXd& theta) const;

  // Bounds of the model itself: signs, range of times, bounds of nuisances. The condition that
  // shares sum to less than one is not a bound and is not included.
  Eigen::VectorXd lower() const;
  Eigen::VectorXd upper() const;

 private:
  const SpectralModel& model_;
  Eigen::Index n_terms_;
  bool by_shares_;
};

// Least squares in all parameters within low <= theta <= high (trust region of Ceres). The start is
// moved into the bounds. A parameter with low == high is held.
SpectralState solve_in_box(const Parametrisation& form, const Eigen::VectorXd& low,
                           const Eigen::VectorXd& high, const SpectralState& start);

}  // namespace viscard
