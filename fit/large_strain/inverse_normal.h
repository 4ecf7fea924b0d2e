#pragma once

#include "fit/large_strain/large_strain_result.h"

#include <Eigen/Core>

#include <vector>

namespace viscard {

// Inverse of J^T J over the free parameters, zero elsewhere; directions that the data do not show go to unseen.
Eigen::MatrixXd inverse_normal(const Eigen::MatrixXd& slopes, const std::vector<Eigen::Index>& free,
                               UnseenDirections& unseen);

}  // namespace viscard
