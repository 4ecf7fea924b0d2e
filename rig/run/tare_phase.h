#pragma once

#include "rig/run/test_run.h"

namespace viscard {

// A force above this share of the cell's capacity before anything was moved means that something
// presses on the load cell already.
inline constexpr double kPressesAtStart = 0.1;

// Measures zero and noise of the load cell, checks the rate of its readings, and lifts the stage by
// 0.1 mm. If the force falls, a punch was left in the specimen; without this check it would be
// tared away and pressed on. It is then lifted until it is free, and the run ends, or goes on with
// a new zero if run.lifts_at_start. Throws RigError if the punch was pressing, if something else
// presses on the cell, if the stage moves the wrong way, or if readings come too slowly for the
// approach to stop in time.
void carry_out_tare(TestRun& run, const TestPhase& phase);

}  // namespace viscard
