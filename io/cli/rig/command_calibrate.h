#pragma once

#include "io/cli/words/streams.h"

namespace viscard {

// viscard calibrate: dead weights on the load cell, or a rigid block under the punch.
int run_calibrate(const std::vector<std::string>& words, Streams& streams);

}  // namespace viscard
