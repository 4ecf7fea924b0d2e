#include "models/array/contact/cut_top.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace viscard {
namespace {

constexpr int kEdgeSamples =
    16;  // along each side of the square of +-1 point distance around a point
// How far beyond the middle between two points a contact reaches that ends at one of them, over their distance; and
// the softness of a point that is half covered over that of one between held points. With these, round and straight
// edges anywhere between the points change the force by less than the next finer grid does (tests).
constexpr double kEdgeReach = -0.1, kEdgeSoftness = 2.0;
constexpr double kLeastCover = 0.01;  // below, a point is left out

// Whether the surface ends between a point and one of its neighbours.
bool is_near_end(const Eigen::MatrixXd& overlap_m, Eigen::Index ring, Eigen::Index a) {
  const Eigen::Index angles = overlap_m.cols();
  const bool is_here = std::isfinite(overlap_m(ring, a));
  for (Eigen::Index i = std::max<Eigen::Index>(ring - 1, 0);
       i <= std::min(ring + 1, overlap_m.rows() - 1); ++i) {
    for (Eigen::Index j = a + angles - 1; j <= a + angles + 1; ++j) {
      if (std::isfinite(overlap_m(i, j % angles)) != is_here) return true;
    }
  }
  // Across the axis.
  return ring == 0 && std::isfinite(overlap_m(0, (a + angles / 2) % angles)) != is_here;
}

}  // namespace

PointCover point_cover(const Overlap& overlap, const std::vector<double>& radius_m, int angles) {
  const auto rings = static_cast<Eigen::Index>(radius_m.size());
  const double step_m = radius_m.front(), step = 2.0 * std::numbers::pi / angles;
  const auto at = [&](double r_m, double angle) {
    return overlap(r_m * std::cos(angle), r_m * std::sin(angle));
  };
  PointCover cover;
  cover.overlap_m.resize(rings, angles);
  for (Eigen::Index ring = 0; ring < rings; ++ring) {
    for (int a = 0; a < angles; ++a)
      cover.overlap_m(ring, a) = at(radius_m[static_cast<std::size_t>(ring)], step * a);
  }
  cover.is_cut = !cover.overlap_m.allFinite() && cover.overlap_m.array().isFinite().any();
  if (!cover.is_cut) return cover;
  const Eigen::MatrixXd at_points_m = cover.overlap_m;
  cover.share = at_points_m.array().isFinite().cast<double>();
  for (Eigen::Index ring = 0; ring < rings; ++ring) {
    for (int a = 0; a < angles; ++a) {
      if (!is_near_end(at_points_m, ring, a)) continue;
      int covered = 0;
      double nearest = std::numeric_limits<double>::infinity();
      double nearest_m = at_points_m(ring, a);
      for (int k = 0; k < kEdgeSamples * kEdgeSamples; ++k) {
        const int row = k / kEdgeSamples, column = k % kEdgeSamples;
        const double x = (2.0 * row + 1.0) / kEdgeSamples - 1.0;
        const double y = (2.0 * column + 1.0) / kEdgeSamples - 1.0;
        const double sample_m =
            at(radius_m[static_cast<std::size_t>(ring)] + x * step_m, step * (a + y));
        if (!std::isfinite(sample_m)) continue;
        ++covered;
        if (std::isfinite(at_points_m(ring, a)) || std::hypot(x, y) >= nearest) continue;
        nearest = std::hypot(x, y);
        nearest_m = sample_m;
      }
      // Distance of the point from the edge, in distances of points.
      const double inside = 2.0 * covered / (kEdgeSamples * kEdgeSamples) - 1.0;
      const double share = std::clamp(inside + 0.5 - kEdgeReach, 0.0, 1.0);
      const bool counts = share >= kLeastCover && std::isfinite(nearest_m);
      cover.share(ring, a) = counts ? share : 0.0;
      cover.overlap_m(ring, a) = counts ? nearest_m : -std::numeric_limits<double>::infinity();
    }
  }
  return cover;
}

Eigen::MatrixXd softness_m_N(const PointCover& cover, const Eigen::VectorXd& stiffness_N_m) {
  return Eigen::MatrixXd::NullaryExpr(
      cover.share.rows(), cover.share.cols(), [&](Eigen::Index ring, Eigen::Index a) {
        const double share = cover.share(ring, a);
        return share > 0.0 ? kEdgeSoftness * (1.0 - share) / share / stiffness_N_m[ring] : 0.0;
      });
}

double share_of(const Eigen::MatrixXd& forces_N, const Eigen::MatrixXd& share,
                const Eigen::VectorXd& ring_area_m2) {
  const Eigen::MatrixXd touched = (forces_N.array() > 0.0).select(share, 0.0);
  return ring_area_m2.dot(touched.rowwise().mean()) / ring_area_m2.sum();
}

}  // namespace viscard
