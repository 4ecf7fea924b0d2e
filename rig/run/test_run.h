#pragma once

#include "models/experiment/rig_config.h"
#include "models/experiment/specimen.h"
#include "models/experiment/test_phases.h"
#include "models/experiment/test_plan.h"
#include "rig/run/run_outcome.h"
#include "rig/run/run_session.h"

#include <vector>

namespace viscard {

// Shared by the phases of one test: the session, the plan, and what is known so far.
struct TestRun {
  RunSession& session;
  const RigConfig& rig;
  const TestPlan& plan;
  const Specimen& specimen;
  std::vector<TestPhase> phases;
  RunOutcome outcome;
  double start_m = 0.0;        // stage position before anything was moved
  double contact_m = 0.0;      // stage position at which the punch touches
  bool is_in_contact = false;  // the last move pressed the punch into the specimen
  bool lifts_at_start =
      false;  // a punch that presses before the test is lifted and the test goes on
  bool presses_at_start = false;  // it pressed, and the run ends because of that
  bool is_tared = false;          // the zero is known and nothing presses
};

// Soft limit of the force, N.
double limit_N(const TestRun& run);

// Indentation by the live contact point and the newest force.
double live_depth_m(TestRun& run);

// Keeps the deepest indentation so far as outcome.achieved_depth_m.
void note_depth(TestRun& run);

// Fills in the totals of a run, adds the doubts about a finished one, and records how it ended. If
// that cannot be recorded any more, the outcome still carries the reason for the early end.
void conclude(RunSession& session, const RigConfig& rig, RunOutcome& outcome,
              const RigClock& clock);

}  // namespace viscard
