#pragma once

#include "io/cli/words/streams.h"

#include <functional>

namespace viscard {

// viscard report: writes one HTML page about captures, tables, material files and a joint fit.
int run_report(const Words& words, Streams& streams);

// Runs one viscard command line and returns its exit status.
using CommandRunner = std::function<int(const Words& words, Streams& streams)>;

// viscard demo: runs the whole flow on the emulated rig for the three mixing ratios of data/demo.
// Each step is a command as a user would type it, run by `run_command`. A step whose outputs are
// newer than its inputs is skipped.
int run_demo(const Words& words, Streams& streams, const CommandRunner& run_command);

}  // namespace viscard
