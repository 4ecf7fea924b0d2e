#pragma once

#include "models/array/contact/rigid_shape.h"
#include "models/array/contact/top_contact.h"

#include <functional>
#include <limits>
#include <optional>
#include <vector>

namespace viscard {

// A pillar that a shape may touch.
struct TouchedPillar {
  double x_m = 0.0, y_m = 0.0;
  double above_m = 0.0;  // how far its top stands above the plane from which depths are counted
  int of_class = 0;
};

// All pillars under one shape.
struct PressedArray {
  double depth_m = 0.0;
  double force_N = 0.0;  // of all pillars
  int contacts = 0;      // pillars that are touched
  bool has_partial = false;
  std::vector<TopPressure> tops;

  void add(const TopPressure& top);
};

// Depth at which a point of the top's grid is touched first, and whether the surface covers all of them.
struct FirstTouch {
  double depth_m = std::numeric_limits<double>::infinity();
  bool covers = true;
};
FirstTouch first_touch_of(const RigidShape& shape, const TouchedPillar& one,
                          const TopCompliance& top);

// What a shape does to the tops: it only pushes them, or they follow it everywhere and are pulled too.
enum class TopBond { kPushed, kFollows };

// Pillars do not feel each other through a film on a rigid base, so that each is pressed alone. `classes`
// has the contact of each class of pillars. `last` keeps forces of each top from one depth to the next, as a start.
PressedArray press_to_depth(const std::vector<TouchedPillar>& pillars,
                            const std::vector<TopContact>& classes, const RigidShape& shape,
                            double depth_m, TopBond bond = TopBond::kPushed,
                            std::vector<Eigen::MatrixXd>* last = nullptr);

// The depth at which the shape bears the force, to rounding: the force grows with the depth. Throws
// std::invalid_argument unless the force is positive and there is a pillar under the shape. `near_m`: a depth that is
// about right, as from a coarser grid.
PressedArray press_with_force(const std::vector<TouchedPillar>& pillars,
                              const std::vector<TopContact>& classes, const RigidShape& shape,
                              double force_N, TopBond bond = TopBond::kPushed,
                              std::optional<double> near_m = {});

// Two depths, and the excess of their forces over the one that is sought; forces grow with the depth.
struct DepthBracket {
  double low_m = 0.0, high_m = 0.0;
  double below_N = 0.0, above_N = 0.0;
};
// Calls excess_N_at() until the last excess, at first `found`, is at most `enough`, or at rounding: secants between the
// depths, halved at the end that stays (Illinois method: Dowell & Jarratt, BIT 11 (1971) 168).
void narrow_depths(DepthBracket at, double found_N, double enough_N,
                   const std::function<double(double depth_m)>& excess_N_at);

// A search for the depth of a force, from a depth at which it is less.
struct DepthSearch {
  double low_m = 0.0, guess_m = 0.0;  // guess_m > low_m
  double force_N = 0.0;
  double accuracy = 1e-13;  // relative, of the force
};
// Calls force_N_at() until the last call has met the force: it grows with the depth. Stops at rounding.
void depth_of_force(const std::function<double(double depth_m)>& force_N_at,
                    const DepthSearch& search);

}  // namespace viscard
