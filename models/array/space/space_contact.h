#pragma once

#include "models/array/contact/foundation.h"
#include "models/array/contact/press_array.h"
#include "models/array/contact/relaxing_tops.h"
#include "models/array/contact/sliding_top.h"
#include "models/array/space/space_scene.h"

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace viscard {

// The tops of a scene's array under its shape, as loads on the array, and their changes from a grid
// with elements twice as large.
struct SpaceContact {
  PressedArray pressed;
  TopLoads loads_Pa;  // a pressure and two tilts that have the force and the moments of each top
  std::vector<double> force_change_N;
  std::vector<double> share_change;  // and what a grid leaves open
  TopLoads change_Pa;
  std::vector<double> sideways_m;  // how far a tilted or sheared top moves
  std::vector<double> twist_Pa;    // shear at its rim by a torque (tops that stick)
  double total_change_N = 0.0;
  double depth_change_m = 0.0;
  int contact_change = 0;
  double stiffness_error = 0.0;  // relative, of every force at a depth, or of the depth of a force
  double settling_share = 0.0;   // of the film in the way of a pressed top
  // With adhesion, by pillar: where its top lets go, NaN if it was never held; and its pull-off force.
  std::vector<double> release_m, pull_off_N;

  double largest_force_N() const;
};

// Grids of the tops, each with elements half as large as the one before; one less for tops that stick.
constexpr int kContactGrids = 4;

// On one of the grids, 0 to kContactGrids - 1; without changes.
SpaceContact contact_on(const SpaceScene& scene, int grid);

// The tops of a scene on one grid, for many states. The scene must outlive them.
class SpaceTops {
 public:
  SpaceTops(const SpaceScene& scene, int grid);
  SpaceTops on_grid(int grid) const;  // another one

  SpaceContact at_rest() const;                 // under the shape as the scene has it
  SpaceContact at_depth(double depth_m) const;  // elastic
  RelaxingTops relaxing(const std::vector<std::size_t>& pillars) const;
  std::vector<SlidingTop> dragged(const std::vector<std::size_t>& pillars) const;
  // Loads of all pillars; pillars that are not named bear nothing.
  SpaceContact contact_of(const PressedArray& some, const std::vector<std::size_t>& pillars) const;

 private:
  struct Parts;
  explicit SpaceTops(std::shared_ptr<const Parts> parts) : parts_(std::move(parts)) {}

  std::shared_ptr<const Parts> parts_;
};

// A pressure, two tilts and two shears with the forces and the moments of a top of radius R. Tilting
// tractions point up, pressures down.
Eigen::Matrix<double, 1, kTopLoads> load_of(const TopPressure& top, double R_m);
// The loads of tops: those of the pillars, in their order.
TopLoads loads_of_tops(const SpaceScene& scene, const std::vector<TopPressure>& tops,
                       const std::vector<std::size_t>& pillars);

// Refines the grids until no force changes by more than the tolerance times the largest force, or
// until the finest grid is reached. Tops that are touched everywhere have no error.
SpaceContact contact_within(const SpaceScene& scene, double tolerance);

// Throws SceneMistake if a table of heights has a tip that the finest grid of a top does not
// resolve: a node of the table that reaches below the top, while no grid point is even half as
// deep.
void refuse_missed_tips(const SpaceScene& scene, double depth_m);

// The array as an elastic foundation.
FoundationPress foundation_press(const SpaceScene& scene);

}  // namespace viscard
