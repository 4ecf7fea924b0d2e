#pragma once

#include "models/array/contact/press_array.h"

#include <limits>
#include <vector>

namespace viscard {

// Between which depths of a shape a top stays flat on it by adhesion (eq. T8).
struct TopHold {
  double touched_m = std::numeric_limits<double>::infinity();   // a point of the top is touched
  double released_m = std::numeric_limits<double>::infinity();  // the pull reaches its limit
};

// Whether a top is held at the end of a path of depths, or was at any turn of it. Before the path nothing
// is touched.
bool is_held_after(const TopHold& hold, const std::vector<double>& path_m);
bool is_ever_held(const TopHold& hold, const std::vector<double>& path_m);

// A surface that is bent by b over a top of radius R, besides its tilt, leaves pressures of up to this times E b/R that
// sum to nothing: a part of the top pulls, and lifts, where the mean pressure is less. Spheres and cylinders have 1.4 to
// 1.7, a ridge over the middle 0.8, half-way to the rim 2.8, nearer to the rim more on less of the top.
constexpr double kPullOfBend = 6.0;

// A top as a column under the surface, for estimates.
struct PulledColumn {
  double lowest_m = 0.0, mean_m = 0.0, highest_m = 0.0;  // of the surface above it, at depth 0
  double stiffness_Pa_m = 0.0;                           // mean stress per stretch
  double limit_Pa = 0.0;                                 // mean pull at pull-off
};

// Largest mean pull on the column from where it is touched to the end of the path, at most its limit. `lets_go`:
// the depth of its release counts as well, so that a touched top is pulled up to the limit. 0 for a top that is
// not touched, or not covered.
double largest_pull_Pa(const PulledColumn& column, const std::vector<double>& path_m, bool lets_go);

// Pull-off force of a strip of that width with a crack at its edge, per metre across the plane; E* of
// the plane: E in plane stress, E/(1 - nu^2) in plane strain (eq. T8).
double strip_pull_off_N_m(double width_m, double plane_modulus_Pa, double work_J_m2);

// Of each pillar; `pull_off_N` by class. Tops that the surface does not cover are never held.
std::vector<TopHold> holds_of(const std::vector<TouchedPillar>& pillars,
                              const std::vector<TopContact>& classes, const RigidShape& shape,
                              const std::vector<double>& pull_off_N);

// The array at the end of a path: tops that are held follow the shape, others are pushed at most.
PressedArray press_along(const std::vector<TouchedPillar>& pillars,
                         const std::vector<TopContact>& classes, const RigidShape& shape,
                         const std::vector<TopHold>& holds, const std::vector<double>& path_m);

}  // namespace viscard
