#pragma once

#include "io/cli/words/streams.h"

#include <string>
#include <vector>

namespace viscard {

// viscard cost: error of a scene against time and memory, over discretisations and effects.
int run_cost(const std::vector<std::string>& words, Streams& streams);

}  // namespace viscard
