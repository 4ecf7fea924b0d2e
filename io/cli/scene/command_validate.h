#pragma once

#include "io/cli/words/streams.h"

#include <string>
#include <vector>

namespace viscard {

// viscard validate: runs the pillar in relaxation and creep with a material and compares with the
// exact answers (models/pillar/validate_material.h). Fails above the largest error allowed.
int run_validate(const std::vector<std::string>& words, Streams& streams);

}  // namespace viscard
