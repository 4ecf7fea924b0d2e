#pragma once

#include "rig/run/test_run.h"

namespace viscard {

// Checks of the first press of a test from the contact, against what tare and touch have shown.

// Before it: the force at rest must still be the tare, within what a cell drifts. zero: the mean at the
// end of the baseline. Throws RigError if the zero has jumped.
void check_zero(TestRun& run, const ForceMean& zero);

// Way of the stage from the contact for that force, by the stiffness of the touch, and by more if
// the specimen relaxes as relaxation_guess says. Infinite if the touch has not shown its stiffness
// well.
double longest_way_m(const TestRun& run, double force_N);
// While it presses to a force: throws ForceDoesNotFollow if the punch goes far deeper.
void check_way(TestRun& run, double force_N);

// In the hold behind a press to a depth: adds a doubt if the force at its end, or the depth that it
// leaves to the specimen, is not the one that the stiffness of the touch implies. depth_m: asked.
void check_press(TestRun& run, double depth_m);

}  // namespace viscard
