#pragma once

#include "io/cli/words/streams.h"

#include <string>
#include <vector>

namespace viscard {

// viscard calibrate: the load cell with dead weights, or the frame with a rigid block.
int run_calibrate(const std::vector<std::string>& words, Streams& streams);

}  // namespace viscard
