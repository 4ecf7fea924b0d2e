#pragma once

#include "io/cards/deck.h"

#include <string>

namespace viscard {

// Parts of a one-element model that Abaqus and CalculiX share.

// Nodes 1 to 8 of the cube and the node sets BASE and TOP.
std::string keyword_cube();
// The rollers and the amplitude RAMP, which rises from 0 to 1 and stays.
std::string keyword_rollers_and_ramp(const DeckInput& input);
// The pull of a step, a force in creep and a displacement in relaxation.
std::string keyword_pull(const DeckInput& input);

}  // namespace viscard
