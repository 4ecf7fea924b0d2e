#pragma once

#include "models/array/contact/shape_press.h"

#include <vector>

namespace viscard {

// A surface that is bent by b over a top of radius R, besides its tilt, leaves pressures of up to this times E b/R that
// sum to nothing: a part of the top pulls, and lifts, where the mean pressure is less. Spheres and cylinders have 1.4 to
// 1.7, a ridge over the middle 0.8, half-way to the rim 2.8, nearer to the rim more on less of the top.
constexpr double kPullOfBend = 6.0;

// A pillar as a column E A/l under the surface, for estimates; a strip per metre across the plane.
struct FoundationColumn {
  double lowest_m = 0.0, mean_m = 0.0, highest_m = 0.0;  // of the surface above its top, at depth 0
  double bent_m = 0.0;  // of the surface, between the ends of a diameter
  double area_m2 = 0.0, length_m = 0.0, radius_m = 0.0;
  double stiffness_Pa_m = 0.0;  // mean stress per stretch
  double limit_Pa = 0.0;        // mean pull at pull-off; 0: it is not held

  double force_N(double depth_m) const;
};

// Pillars as an elastic foundation of columns, a closed form before anything is solved.
struct FoundationPress {
  double depth_m = 0.0;
  double largest_Pa = 0.0;  // largest mean pressure on a top
  double pull_Pa = 0.0;     // largest mean pull on a top that adheres, along the path of depths
  double shortening = 0.0;  // of a pillar, the largest over its length
  double lowest_m = 0.0;    // of the surface over all tops; infinite: there is none
  // How far a point of any top stays above the surface, or would be pulled under a bent one, and half the rise of the
  // surface over a touched top, both over the largest overlap; 1 and 0 if the shape touches nothing.
  double lift = 1.0, turn = 0.0;
  bool covers_all = true;  // there is a surface above every top
};
// At least one column. `wants_release`: the depth at which held tops let go counts as well, so that a touched one is
// pulled up to its limit.
FoundationPress foundation_press(const std::vector<FoundationColumn>& columns,
                                 const ShapePress& press, bool wants_release);

}  // namespace viscard
