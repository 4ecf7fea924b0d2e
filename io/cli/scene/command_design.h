#pragma once

#include "io/cli/words/streams.h"

#include <string>
#include <vector>

namespace viscard {

// viscard design: closed-form limits of a pillar sensor, the longest admissible pillar, and
// pictures of the admissible region.
int run_design(const std::vector<std::string>& words, Streams& streams);

}  // namespace viscard
