#pragma once

#include "rig/stages/stage.h"

namespace viscard {

// The software limit that every stage driver checks: throws RigError if to_m lies further toward
// the specimen than travel_m from start_m, where the stage stood at first.
void check_travel(double to_m, double start_m, double travel_m);

// Limits the end of a move to what the controller allows (StageDynamics::lowest_m, highest_m), on a
// whole step. A move away from the specimen is shortened, because a shorter lift is better than
// none. A move toward the specimen beyond the limit throws RigError, and so does any move that
// starts outside of the travel.
double within_travel_m(double from_m, double to_m, const StageDynamics& dynamics);

}  // namespace viscard
