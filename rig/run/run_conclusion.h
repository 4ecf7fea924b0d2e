#pragma once

#include "rig/lines/rig_clock.h"
#include "rig/run/run_outcome.h"
#include "rig/run/run_session.h"

namespace viscard {

// Fills in the totals of a run, adds the doubts about a finished one, and records how it ended. If
// that cannot be recorded any more, the outcome still carries the reason for the early end.
void conclude(RunSession& session, RunOutcome& outcome, const RigClock& clock);

}  // namespace viscard
