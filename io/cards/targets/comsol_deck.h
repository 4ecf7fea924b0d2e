#pragma once

#include "io/cards/deck.h"

#include <string>
#include <vector>

namespace viscard {

std::vector<DeckFile> comsol_deck(const DeckInput& input, const std::string& name);

}  // namespace viscard
