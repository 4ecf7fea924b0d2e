#pragma once

#include "io/cli/words/streams.h"

#include <string>
#include <vector>

namespace viscard {

// viscard rig list: lists serial ports and why one cannot be used.
// viscard rig check: identifies both devices of a rig file, measures them and reads their settings.
// viscard rig overshoot: the force beyond a limit on the emulated rig.
int run_rig(const std::vector<std::string>& words, Streams& streams);

}  // namespace viscard
