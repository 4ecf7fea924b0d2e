#pragma once

#include "models/array/contact/top_pressure.h"

#include <Eigen/Core>

#include <vector>

namespace viscard {

// A surface that ends above a top (an edge, the border of a table) covers some points of its grid in part
// (eq. T10): an edge moves the contact by parts of the distance of points, not by whole ones.
struct PointCover {
  Eigen::MatrixXd overlap_m;  // -infinity at points that the surface does not reach
  Eigen::MatrixXd share;  // of each point that the surface covers, 0 to 1; empty unless it is cut
  bool is_cut = false;
};
PointCover point_cover(const Overlap& overlap, const std::vector<double>& radius_m, int angles);

// How much softer points bear that are covered in part, m/N: (1 - share)/share over the stiffness of a point
// between others that are held. `stiffness_N_m`: of a point of each ring.
Eigen::MatrixXd softness_m_N(const PointCover& cover, const Eigen::VectorXd& stiffness_N_m);

// Of the area of a top, where points push that a surface covers by these shares.
double share_of(const Eigen::MatrixXd& forces_N, const Eigen::MatrixXd& share,
                const Eigen::VectorXd& ring_area_m2);

}  // namespace viscard
