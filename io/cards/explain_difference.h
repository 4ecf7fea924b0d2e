#pragma once

#include "io/cards/read_card.h"

#include <vector>

namespace viscard {

// Explains a card that differs from the material it is meant to be. Applies each known mistake to
// the expected numbers, then each pair, and returns the one or two that reproduce the card:
// "tau-for-beta", "g-for-G", "plane-strain-modulus" ... Empty if none does.
std::vector<CardFinding> explain_difference(const ReadCard& read, const Material& reference);

}  // namespace viscard
