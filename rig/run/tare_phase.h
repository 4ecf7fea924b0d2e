#pragma once

#include "rig/run/test_run.h"

namespace viscard {

// Measures zero and noise of the load cell, checks that its readings are those of a cell that
// measures (rest_findings.h) and come at the expected rate, and lifts the stage by 0.1 mm. If the force falls, a punch was left in the specimen; without this check it would be
// tared away and pressed on. It is then lifted until it is free, and the run ends, or goes on with
// a new zero if run.lifts_at_start. Throws RigError if the cell does not measure, if the punch was
// pressing, if something else presses on the cell, if the stage moves the wrong way, or if the rate
// is not the expected one.
void carry_out_tare(TestRun& run, const TestPhase& phase);

}  // namespace viscard
