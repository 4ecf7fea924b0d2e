#pragma once

#include "models/material/material.h"

#include <Eigen/Core>

#include <vector>

namespace viscard {

// One specimen in the joint fit: (ln E0, ln g_i, ln tau_i) with the error covariance of its fit.
struct RatioEstimate {
  double ratio = 0.0;
  Eigen::VectorXd theta;
  Eigen::MatrixXd covariance;
};

// Throws std::invalid_argument that names the specimen: no ratio, no covariance, a number of terms
// that differs from the first specimen's, a share of zero.
std::vector<RatioEstimate> ratio_estimates_of(const std::vector<Material>& specimens);

std::vector<double> distinct_ratios(const std::vector<RatioEstimate>& estimates);  // ascending

}  // namespace viscard
