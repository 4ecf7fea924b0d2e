#pragma once

#include <functional>

namespace viscard {

// What a rigid surface does to the top of one pillar.
struct TopPressure {
  double force_N = 0.0;      // down
  double moment_x_Nm = 0.0;  // int p x dA: turns the top toward +x
  double moment_y_Nm = 0.0;
  // Of a top that sticks: on the top along x and y, and about its axis from x to y.
  double shear_x_N = 0.0, shear_y_N = 0.0, torque_Nm = 0.0;
  double share = 0.0;  // of the top's area that is touched
  // Of the share: half a ring along the rim of the touched area, whose points touch or do not.
  double share_error = 0.0;
  double largest_Pa = 0.0;  // pressure at a point of the grid
  bool is_partial = false;  // some of the top, but not all, is touched
  bool is_cut = false;      // the surface ends above the top
};

// The least share of its change before that the change of a top keeps from one grid to the next, where that has half
// the element size h. Without it, two grids that agree by chance would pass as converged: the edge of the surface or of
// the contact lies among the points of the top differently on each grid. Where the surface ends above the top, the error
// falls as h; where the contact ends on it, as h^1.5, because the pressure is zero at that edge. 0 elsewhere.
inline double kept_share(const TopPressure& top) {
  if (top.is_cut) return 0.5;
  return top.is_partial ? 0.35 : 0.0;  // 2^-1.5
}

// How far the surface reaches below the unloaded top at a point of it, m; negative where it stays above,
// and -infinity where there is no surface.
using Overlap = std::function<double(double x_m, double y_m)>;

}  // namespace viscard
