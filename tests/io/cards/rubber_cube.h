#pragma once

#include "models/hyperelastic/deformation.h"

#include <string>

namespace viscard {

// The deck of CalculiX for a cube of edge 1 on rollers, stretched to `stretch` along z; its sides are as the
// deformation has them. The card's material is RUBBER.
std::string cube_deck(const std::string& card, Deformation deformation, double stretch);

// Force on the top after a run of ccx, in the unit of the deck.
double run_in_calculix(const std::string& deck);

}  // namespace viscard
