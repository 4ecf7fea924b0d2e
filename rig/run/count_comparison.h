#pragma once

#include "rig/run/run_control.h"
#include "rig/run/run_outcome.h"
#include "rig/run/run_session.h"

#include <string>

namespace viscard {

// After the lift of a finished run with home = true, and only if nothing else makes it doubtful:
// homes the stage and compares its count. Lost steps, and a stage that could not be homed, are
// doubts. Returns why the count was not compared, or "". Throws what ends a run in any phase: a limit
// of force, a person, a lost port, a load cell that is silent or measures nothing; the stage must be
// made safe then.
std::string compare_count(RunSession& session, const RigConfig& rig, const RunControl& control,
                          RunOutcome& outcome);

// Of a run that was not to be compared.
inline constexpr const char* kNotHomed = "not homed";

// States in the outcome, and in the record, what the depth is. why: of compare_count().
void record_depth(RunSession& session, const std::string& why, RunOutcome& outcome);

// The doubt that a comparison gives, for each run since the stage was homed before; empty: none.
std::string lost_steps_doubt(const CountCheck& found);
// The value of the event "doubt" that carries it.
inline constexpr const char* kLostStepsDoubt = "lost_steps";

}  // namespace viscard
