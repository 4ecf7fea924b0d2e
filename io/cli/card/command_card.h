#pragma once

#include "io/cli/words/streams.h"

#include <string>
#include <vector>

namespace viscard {

// viscard card: writes a material card for a solver, lists targets, checks cards, proves them.
int run_card(const std::vector<std::string>& words, Streams& streams);

}  // namespace viscard
