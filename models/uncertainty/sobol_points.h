#pragma once

#include "models/uncertainty/uncertain_input.h"

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace viscard {

// The first points of Sobol's sequence in the unit cube, one per row, shifted by half a cell so that none
// lies on its surface. Direction numbers of Joe & Kuo, SIAM J. Sci. Comput. 30 (2008) 2635 (Boost.Random).
// Throws std::invalid_argument for more than 3667 dimensions.
Eigen::MatrixXd sobol_points(Eigen::Index n_points, Eigen::Index n_dimensions);

// The same points moved by a random vector, modulo 1: another sequence as even as the first. Cranley &
// Patterson, SIAM J. Numer. Anal. 13 (1976) 904. The same seed gives the same points on every machine.
Eigen::MatrixXd shifted(Eigen::MatrixXd points, std::uint64_t seed);

// Standard deviates of points in the unit cube, by the inverse of each distribution.
Eigen::MatrixXd deviates_from(const Eigen::MatrixXd& points,
                              const std::vector<UncertainInput>& inputs);

}  // namespace viscard
