#pragma once

#include "io/cli/words/streams.h"

#include <functional>
#include <string>
#include <vector>

namespace viscard {

// Runs one viscard command line and returns its exit status.
using CommandRunner = std::function<int(const std::vector<std::string>& words, Streams& streams)>;

// viscard demo: the whole flow on the emulated rig for the three mixing ratios of data/demo, as the
// commands a user would type, each carried out by `run_command`. A step whose outputs are newer
// than its inputs is skipped.
int run_demo(const std::vector<std::string>& words, Streams& streams,
             const CommandRunner& run_command);

}  // namespace viscard
