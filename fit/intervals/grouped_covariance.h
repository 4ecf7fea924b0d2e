#pragma once

#include "fit/curves/spectral_model.h"
#include "fit/intervals/slow_noise.h"
#include "fit/samples/noise_model.h"

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace viscard {

// Rows of a model that share one noise: those of one of several tests.
struct NoiseGroup {
  Eigen::Index first_row = 0, n_rows = 0;
  std::vector<std::size_t> begins;  // samples of each row, counted within the group
  double n_samples = 0.0;
  double variance = 1.0;  // of one sample, in the weight of the rows
  Autoregression noise;
  SlowNoise slow;
  Eigen::VectorXd row_scale;  // standard deviation of each row over that of all; empty if alike
};

// Linear functions of the rows, x = W^T r, whose errors are wanted: W has one column for each.
// Returns the covariance of x from the noise of each group, including its slow part (slow_noise.h).
std::vector<Eigen::MatrixXd> covariance_by_group(const Eigen::MatrixXd& rows_by_value,
                                                 const std::vector<NoiseGroup>& groups);

// Covariance of all parameters of a state, in the order of full_jacobian(), with the noise of each
// group: (J^T J)^-1 (sum J_k^T C_k J_k) (J^T J)^-1 (fit/intervals/README.md, "Several tests").
// Parameters that do not influence the data get an infinite variance.
Eigen::MatrixXd grouped_covariance(const SpectralModel& model, const SpectralState& state,
                                   const std::vector<NoiseGroup>& groups);

// How many parameters each group determines: the sum of its leverages.
Eigen::VectorXd leverage_by_group(const SpectralModel& model, const SpectralState& state,
                                  const std::vector<NoiseGroup>& groups);

}  // namespace viscard
