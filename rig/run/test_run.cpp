#include "rig/run/test_run.h"

#include <algorithm>

namespace viscard {

double limit_N(const TestRun& run) {
  return run.rig.safety.soft_fraction * run.rig.calibration.capacity_N;
}

double live_depth_m(TestRun& run) {
  const double frame_N_m = run.rig.frame.stiffness_N_m;
  return run.session.stage().position_m() - run.contact_m -
         (frame_N_m > 0.0 ? run.session.force_N() / frame_N_m : 0.0);
}

void note_depth(TestRun& run) {
  run.outcome.achieved_depth_m = std::max(run.outcome.achieved_depth_m, live_depth_m(run));
}

}  // namespace viscard
