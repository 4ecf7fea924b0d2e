#pragma once

#include "io/cards/card_target.h"

#include <string>
#include <vector>

namespace viscard {

// The table of targets, in the order of --list.
const std::vector<CardTarget>& card_targets();

// Throws std::invalid_argument listing the targets.
const CardTarget& card_target(const std::string& name);

// The one-element model of a target. Throws std::invalid_argument listing the targets that have
// one.
const DeckWriter& card_deck(const std::string& name);

}  // namespace viscard
