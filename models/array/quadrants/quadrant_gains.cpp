#include "models/array/quadrants/quadrant_gains.h"

#include "models/maths/require.h"

#include <Eigen/LU>

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace viscard {
namespace {

constexpr double kLeastDeterminant = 1e-12;  // of a normal matrix with diagonal 1
constexpr int kMostNodes = 100000;

}  // namespace

QuadrantGains quadrant_gains(const QuadrantResponse& response) {
  // Scales the columns to length 1, because a pressure and a shear may differ by orders of
  // magnitude.
  const Eigen::Vector3d size = response.colwise().norm().transpose();
  require(size.minCoeff() > 0.0 && size.allFinite(),
          "the quarters read nothing of one of the loads; the film must be piezoelectric");
  const Eigen::Vector3d inverse_size = size.cwiseInverse();
  const QuadrantResponse scaled = response * inverse_size.asDiagonal();
  const Eigen::Matrix3d normal = scaled.transpose() * scaled;
  require(normal.determinant() > kLeastDeterminant,
          "the quarters do not tell pressure and shear apart");
  return inverse_size.asDiagonal() * normal.inverse() * scaled.transpose();
}

Eigen::Matrix<double, kSensedLoads, 1> sensed_noise_Pa(const QuadrantGains& gains, double noise_V) {
  return noise_V * gains.rowwise().norm();
}

std::vector<QuadrantNode> nodes_of(const NodeMeans& means, double radius_m) {
  require(
      means.circles >= 1 && means.on_circle >= 4 && means.circles <= kMostNodes / means.on_circle,
      "a mesh of nodes needs a circle or more, of four nodes or more, and at most 100000 nodes");
  std::vector<QuadrantNode> nodes;
  std::array<int, 4> counts{};
  const auto add = [&](double x_m, double y_m) {
    const double tiny_m = 1e-9 * radius_m;  // on an axis
    const bool is_right = x_m >= -tiny_m, is_above = y_m >= -tiny_m;
    const int quarter = is_above ? (is_right ? 0 : 1) : (is_right ? 3 : 2);
    ++counts.at(static_cast<std::size_t>(quarter));
    nodes.push_back({x_m, y_m, quarter, 0.0});
  };
  add(0.0, 0.0);
  for (int circle = 1; circle <= means.circles; ++circle) {
    const double r_m = radius_m * circle / means.circles;
    for (int i = 0; i < means.on_circle; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / means.on_circle;
      add(r_m * std::cos(angle), r_m * std::sin(angle));
    }
  }
  for (const int count : counts) require(count > 0, "a quarter of the electrode has no node");
  for (QuadrantNode& node : nodes) {
    node.weight = 1.0 / counts.at(static_cast<std::size_t>(node.quarter));
  }
  return nodes;
}

}  // namespace viscard
