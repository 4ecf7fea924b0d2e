#pragma once

#include "io/cards/read_card.h"

#include <string>
#include <vector>

namespace viscard {

// The blocks [Materials] and [UserObjects] of an input file of MOOSE, without comments. Mistakes: a block without type,
// a parameter that stands in its block twice, a strain without displacements. Types and parameters that no reader of
// cards knows are the note "not-read". Throws std::runtime_error for a block that is not open, or not closed.
std::vector<CardFinding> moose_block_findings(const std::string& text);

}  // namespace viscard
