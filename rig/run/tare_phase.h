#pragma once

#include "rig/run/test_run.h"

namespace viscard {

// A force above this share of the soft limit before anything was moved means that something presses
// on the load cell already.
inline constexpr double kPressesAtStart = 0.5;

// Measures zero and noise of the load cell, then checks the rate of its readings. Throws RigError
// if something presses already, or if readings come too slowly for the approach to stop in time.
void carry_out_tare(TestRun& run, const TestPhase& phase);

}  // namespace viscard
