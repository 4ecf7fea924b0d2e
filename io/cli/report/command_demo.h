#pragma once

#include "io/cli/words/streams.h"

#include <string>
#include <vector>

namespace viscard {

// viscard demo: the whole flow on the emulated rig, as the commands a user would type, for the
// three mixing ratios of data/demo. Steps whose outputs are newer than their inputs are not done
// again.
int run_demo(const std::vector<std::string>& words, Streams& streams);

}  // namespace viscard
