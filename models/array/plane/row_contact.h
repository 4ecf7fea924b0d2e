#pragma once

#include "models/array/contact/foundation.h"
#include "models/array/plane/array_scene.h"

#include <Eigen/Core>

#include <limits>
#include <vector>

namespace viscard {

// Degrees of the tractions on a top that reach its foot (eq. A7): a pressure, a tilt, and two more.
constexpr int kTopDegree = 3;

// What a shape does to the top of one strip, per metre across the plane.
struct StripPressure {
  double force_N_m = 0.0;  // down
  double moment_N = 0.0;   // int p x dx: turns the top toward +x
  double shear_N_m = 0.0;  // along +x, of a shape that sticks
  double share = 0.0;      // of the top that is touched
  double share_error = 0.0;
  double release_m =
      std::numeric_limits<double>::quiet_NaN();  // depth at which adhesion lets it go
};

// The tops of a row under its shape, and how far they changed from a grid with elements twice as large.
struct RowContact {
  double depth_m = 0.0;
  double force_N_m = 0.0;  // of all pillars
  int contacts = 0;        // pillars that are touched
  std::vector<StripPressure> tops;
  Eigen::MatrixXd loads_Pa;  // amplitudes of tractions on the tops: ports (traction_port) x pillars
  Eigen::VectorXd sideways_m;  // of each top, its mean

  Eigen::MatrixXd load_changes_Pa;
  std::vector<StripPressure> top_changes;  // magnitudes
  double force_change_N_m = 0.0, depth_change_m = 0.0;
  int contact_change = 0;
  int unknowns = 0;

  double largest_force_N_m() const;
};

// The pull that a top bears at most, per metre across the plane (eq. T8).
double row_pull_off_N_m(const ArrayScene& scene, double work_J_m2);

// Grids of the tops, each with elements half as large as the one before.
constexpr int kRowGrids = 4;

// On one of the grids, 0 to kRowGrids - 1; without changes. Throws std::invalid_argument for a force
// under which there is no pillar.
RowContact row_contact_on(const ArrayScene& scene, int grid);

// On grids of rising fineness until no load changes by more than the tolerance times the largest one, or
// the last one is reached.
RowContact row_contact_within(const ArrayScene& scene, double tolerance);

// Throws SceneMistake where a table of heights has a tip that the finest grid of a top does not see.
void refuse_missed_row_tips(const ArrayScene& scene, double depth_m);

// The row as an elastic foundation of columns.
FoundationPress row_foundation(const ArrayScene& scene);

}  // namespace viscard
