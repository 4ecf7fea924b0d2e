#pragma once

#include "models/experiment/rig_config.h"
#include "models/experiment/specimen.h"
#include "models/experiment/test_plan.h"
#include "rig/cells/load_cell.h"
#include "rig/lines/record_sink.h"
#include "rig/run/run_control.h"
#include "rig/run/run_outcome.h"
#include "rig/stages/stage.h"

namespace viscard {

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
