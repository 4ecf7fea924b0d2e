#pragma once

#include <Eigen/Core>

#include <numbers>

namespace viscard {

// Cosines and sines of the harmonics at equal angles, orthonormal: 1, cos, sin, cos 2, ... angles x angles.
Eigen::MatrixXd unit_waves(int angles);

// Of one of the equal angles, from 0.
inline double point_angle(int index, int angles) {
  return 2.0 * std::numbers::pi * index / angles;
}

// Sum over all points of the products of two values there.
inline double inner(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return a.cwiseProduct(b).sum();
}

}  // namespace viscard
