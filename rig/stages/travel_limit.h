#pragma once

#include "rig/stages/stage.h"

namespace viscard {

// Throws RigError when a move to to_m goes farther toward the specimen than travel_m from where the
// stage stood at first (start_m): the software limit that every stage driver keeps.
void check_travel(double to_m, double start_m, double travel_m);

// The end of a move within what the controller itself allows (StageDynamics::lowest_m, highest_m),
// on a whole step. A move away from the specimen is shortened, since a shorter lift is better than
// none; one toward it throws RigError, and so does any move from outside of the travel.
double within_travel_m(double from_m, double to_m, const StageDynamics& dynamics);

}  // namespace viscard
