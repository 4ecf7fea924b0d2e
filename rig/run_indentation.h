#pragma once

#include "models/experiment/rig_config.h"
#include "models/experiment/specimen.h"
#include "models/experiment/test_plan.h"
#include "rig/cells/load_cell.h"
#include "rig/lines/record_sink.h"
#include "rig/preflight.h"
#include "rig/run/run_control.h"
#include "rig/stages/stage.h"

#include <optional>
#include <string>
#include <vector>

namespace viscard {

// How a run ended and what it amounts to.
struct RunOutcome {
  std::string
      status;  // "finished" | "interrupted" (asked to, or a device was lost) | "stopped" (a limit)
  std::string reason;  // why it did not finish, and what next; empty if it did
  Preflight expected;
  double noise_N = 0.0;  // of one reading, out of contact
  // A garbled digit that changes a reading by less than this can hide between its neighbours; on a
  // ramp, by less than twice the step between readings too; in the first five and the last two, by
  // up to twice as much.
  double hidden_error_N = 0.0;
  bool has_begun = false;  // anything was moved: else the record says nothing of the specimen
  std::optional<double> contact_position_m;  // live estimate; the fit finds it better
  double peak_force_N = 0.0;
  double achieved_depth_m = 0.0;  // the deepest, by that estimate
  StreamCounts stream;
  std::vector<std::string> doubts;  // what speaks against the record although the run finished
};

// Carries out the phases of a test (models/test_phases.h) and hands out everything it receives:
//   connect - tare - approach in short jogs until touched - back off by gap - baseline - preload -
//   what the protocol asks for - retract - baseline.
// "ramp-hold" ends with a quick partial unloading and a second hold, because a ramp of 1 s hides
// terms that are faster: from ramp and hold alone a term of tau .19 s and g .008 is known to 30-40
// % only, with them g_1 + g_2 is known to 4-7 % (Cramer-Rao bound at the noise of the
// demonstration). A force is held by steps of the stage on the mean of a few readings at rest
// (force_control.h).
//
// Whatever happens - limit, interruption, lost device, a sink that throws - the stage is stopped
// first and the punch lifted as far as the devices still answer; then the outcome says so. Records
// end with an event "finished" or "interrupted" or "stopped". Throws RigError only if nothing was
// done yet: a device that does not connect, a plan that preflight refuses. rig.clock_speed is not
// looked at: control.clock rules.
RunOutcome run_indentation(Stage& stage, LoadCell& load_cell, const RigConfig& rig,
                           const TestPlan& plan, const Specimen& specimen, const RecordSink& sink,
                           const RunControl& control);

}  // namespace viscard
