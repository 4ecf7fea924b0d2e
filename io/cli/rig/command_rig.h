#pragma once

#include "io/cli/words/streams.h"

#include <string>
#include <vector>

namespace viscard {

// viscard rig list: serial ports, and why one cannot be used.
// viscard rig check: both devices of a rig file identified, measured, their settings read back.
int run_rig(const std::vector<std::string>& words, Streams& streams);

}  // namespace viscard
