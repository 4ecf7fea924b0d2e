#pragma once

#include "io/cli/words/streams.h"

#include <string>
#include <vector>

namespace viscard {

// viscard simulate: answers a scene file (io/scene_file.h) with error estimates.
int run_simulate(const std::vector<std::string>& words, Streams& streams);

}  // namespace viscard
