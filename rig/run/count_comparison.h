#pragma once

#include "rig/run/run_control.h"
#include "rig/run/run_outcome.h"
#include "rig/run/run_session.h"

namespace viscard {

// After the lift of a finished run with home = true, and only if nothing else makes it doubtful:
// homes the stage and compares its count. Lost steps, and a stage that could not be homed, are
// doubts. States in the outcome what the depth is.
void compare_count(RunSession& session, const RigConfig& rig, const RunControl& control,
                   RunOutcome& outcome);

// The doubt that a comparison gives, for each run since the stage was homed before; empty: none.
std::string lost_steps_doubt(const CountCheck& found);
// The value of the event "doubt" that carries it.
inline constexpr const char* kLostStepsDoubt = "lost_steps";

}  // namespace viscard
