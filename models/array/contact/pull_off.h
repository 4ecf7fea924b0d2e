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
