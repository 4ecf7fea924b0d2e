#pragma once

#include <Eigen/Core>

namespace viscard {

// Cosines and sines of the harmonics at equal angles, orthonormal: 1, cos, sin, cos 2, ... angles x angles.
Eigen::MatrixXd unit_waves(int angles);

}  // namespace viscard
