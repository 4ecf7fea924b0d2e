#pragma once

#include "rig/run/test_run.h"

namespace viscard {

// Longest jog near or in contact: so far does a stage go whose host has died.
inline constexpr double kLongestJog_m = 25e-6;

// Jogs toward the specimen until the force passes the contact threshold, presses a little further to
// measure the stiffness, estimates the contact, checks that the specimen is not too stiff for the
// ramp, and backs off until the force is back at zero. Sets run.contact_m,
// outcome.contact_position_m and, by the stiffness measured, how far the stage goes for a depth. Throws RigError if nothing is touched,
// if the load cell has the wrong sign, or if the force does not return to zero.
void carry_out_approach(TestRun& run);

}  // namespace viscard
