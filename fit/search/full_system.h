#pragma once

#include "fit/curves/spectral_model.h"

namespace viscard {

// Jacobian and residual of all rows, including those within averages.
struct FullSystem {
  Eigen::MatrixXd jacobian;
  Eigen::VectorXd residual;
};

FullSystem full_system(const SpectralModel& model, const SpectralState& state);

// 1 over the length of each column.
Eigen::VectorXd unit_of(const Eigen::MatrixXd& jacobian);

// The state after a change of all parameters, ordered as in full_jacobian().
SpectralState moved_by(const SpectralState& from, const Eigen::VectorXd& change);

}  // namespace viscard
