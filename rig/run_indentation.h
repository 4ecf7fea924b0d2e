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

// Carries out the phases of a test (models/experiment/test_phases.h) and passes every record to the
// sink:
//   connect - tare - approach in short jogs until touched - back off by gap - baseline - preload -
//   the phases of the protocol - retract - baseline.
// A force is held by steps of the stage on the mean of a few readings at rest (force_control.h).
//
// If the run ends early (limit, interruption, lost device, a sink that throws), the stage is
// stopped first and the punch is lifted as far as the devices still answer; the outcome states what
// was done. With home = true under [stage] the stage is homed before the test and again after its
// lift (rig/run/count_comparison.h). The last record is an event "finished", "interrupted" or "stopped". Throws RigError
// only before the test has begun: a device does not connect, or preflight() refuses the plan. The
// time is that of control.clock; rig.clock_speed is not used.
RunOutcome run_indentation(Stage& stage, LoadCell& load_cell, const RigConfig& rig,
                           const TestPlan& plan, const Specimen& specimen, const RecordSink& sink,
                           const RunControl& control);

}  // namespace viscard
