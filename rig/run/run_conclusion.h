#pragma once

#include "rig/lines/rig_clock.h"
#include "rig/run/run_outcome.h"
#include "rig/run/run_session.h"

#include <string>

namespace viscard {

// Fills in what the whole run amounts to, adds doubts about a finished one, and says how it ended,
// without hiding the reason when even that cannot be written any more.
void conclude(RunSession& session, RunOutcome& outcome, const RigClock& clock);

// A sentence on what was done to a stage whose run was ended by the force.
std::string what_was_done(double lifted_m);

}  // namespace viscard
