#pragma once

#include "models/array/space/touch_loads.h"

#include <cstddef>
#include <vector>

namespace viscard {

// A shape on pillars that relax, in time (eq. S14, S15). All pillars relax with one relative
// modulus e(t), so as long as no contact shrinks, the loads on the tops are those of elastic
// pillars at each depth, relaxed as a stress is under a given strain. Ting, J. Appl. Mech. 33
// (1966) 845; Lee & Radok, J. Appl. Mech. 27 (1960) 438. If any contact shrinks, the tops are
// followed step by step (models/array/contact, eq. T6).

// The loads on the tops in time, the finest course with its errors. Rows of loads: the pillars that are touched at the
// deepest state.
struct TouchCourse : GridCourse {
  std::vector<double> time_s;        // a jump has the same time twice
  std::vector<bool> is_new;          // not among half as many steps
  std::vector<std::size_t> touched;  // ascending, index into SpaceScene::pillars
  // Changes by the last refinement of the tops and by the last halving of the steps, as magnitudes.
  std::vector<TopLoads> change_Pa;
  std::vector<double> depth_change_m, force_change_N;
  std::vector<int> contact_change;
  std::vector<Eigen::VectorXd> slip_change_m;
  std::vector<int> sliding_change;
  double stiffness_error = 0.0;  // relative, of all loads
  // Largest change of a load relative to the largest load, and the part above.
  double relative_error = 0.0;
  bool has_shrunk = false;  // a contact shrank, so the course was found step by step
};

// Refines the grids of the tops and the time steps until the loads change by less than the
// tolerance.
TouchCourse touch_course(const SpaceScene& scene, double tolerance);

// The largest size of each load at any time, all pillars.
TopLoads largest_loads(const TouchCourse& course, std::size_t pillars);

// The loads of one time, all pillars.
TopLoads all_loads(const TouchCourse& course, const TopLoads& of_touched, std::size_t pillars);

}  // namespace viscard
