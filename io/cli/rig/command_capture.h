#pragma once

#include "io/cli/words/streams.h"

#include <string>
#include <vector>

namespace viscard {

// viscard capture: runs one indentation on the rig, or on an emulated one, into a capture file.
int run_capture(const std::vector<std::string>& words, Streams& streams);

}  // namespace viscard
