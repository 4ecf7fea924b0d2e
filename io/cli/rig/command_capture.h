#pragma once

#include "io/cli/words/streams.h"

#include <string>
#include <vector>

namespace viscard {

// viscard capture: runs indentation tests on the rig, or on an emulated one, into capture files.
int run_capture(const std::vector<std::string>& words, Streams& streams);

}  // namespace viscard
