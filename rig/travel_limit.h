#pragma once

namespace viscard {

// Throws RigError when a move to to_m goes farther toward the specimen than travel_m from where the
// stage stood at first (start_m): the software limit that every stage driver keeps.
void check_travel(double to_m, double start_m, double travel_m);

}  // namespace viscard
