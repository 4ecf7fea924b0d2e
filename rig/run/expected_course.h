#pragma once

#include "models/experiment/test_plan.h"
#include "rig/run/preflight.h"

#include <string>
#include <vector>

namespace viscard {

// Depth and force that a test is expected to follow, from the end of the approach on: corners of a
// line for each. The force is that of an elastic specimen with the guessed modulus, an upper bound
// for one that relaxes. Not a Course: two quantities have the same corners.
struct ExpectedCourse {
  struct Phase {
    std::string name, text;
    double start_s = 0.0;
  };
  std::vector<double> time_s, depth_m, force_N;
  std::vector<Phase> phases;
  double approach_at_most_s = 0.0;  // before the first point, with the tare
};

// Throws std::invalid_argument as phases_from_plan() does.
ExpectedCourse expected_course(const TestPlan& plan, const Preflight& expected);

}  // namespace viscard
