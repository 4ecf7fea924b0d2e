#pragma once

#include "rig/lines/rig_clock.h"
#include "rig/run/run_outcome.h"
#include "rig/run/run_session.h"

#include <string>

namespace viscard {

// Fills in the totals of a run, adds the doubts about a finished one, and records how it ended. If
// that cannot be recorded any more, the outcome still carries the reason for the early end.
void conclude(RunSession& session, RunOutcome& outcome, const RigClock& clock);

// The sentence on how far the punch was lifted, for the reason of a run that a force ended.
std::string lift_text(double lifted_m);

}  // namespace viscard
