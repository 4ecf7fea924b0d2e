#pragma once

#include "io/cli/words/streams.h"

#include <string>
#include <vector>

namespace viscard {

// viscard scene check: reads a scene, says what contradicts itself, and draws the geometry.
int run_scene(const std::vector<std::string>& words, Streams& streams);

}  // namespace viscard
