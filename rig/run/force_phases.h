#pragma once

#include "rig/run/test_run.h"

namespace viscard {

// The phases that go to a force or hold one. They keep the stiffness measured while loading,
// because the hold that follows uses it for its steps.
class ForcePhases {
 public:
  explicit ForcePhases(TestRun& run) : run_(run) {}

  // Loads to phase.force_N: first most of the way by the guessed stiffness, then the rest by the
  // stiffness measured on the way. Each move ends early, by a gentle stop, when the force is
  // reached.
  void load(const TestPhase& phase);

  // Holds phase.force_N for phase.duration_s by steps of the stage (force_control.h). Throws
  // RigError if the specimen creeps beyond the depth limit.
  void hold(const TestPhase& phase);

 private:
  TestRun& run_;
  double measured_N_m_ = 0.0;  // stiffness measured while loading; 0 before the first load
};

}  // namespace viscard
