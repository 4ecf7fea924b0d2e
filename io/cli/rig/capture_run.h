#pragma once

#include "io/cli/rig/capture_setup.h"
#include "io/cli/words/streams.h"
#include "rig/run_indentation.h"

#include <optional>
#include <string>
#include <vector>

namespace viscard {

// What stands beside the capture, in place of its extension: what an emulated rig was made with,
// and the live page.
inline constexpr const char* kTruthEnding = ".truth.json";
inline constexpr const char* kPageEnding = ".live.html";

// How one capture ended, and the force it saw, for a summary.
struct CaptureOutcome {
  RunOutcome run;
  std::string file;
  std::vector<double> force_N;  // thinned
};

// Opens both ports (or makes an emulated rig), then the file, then runs one test while SIGINT,
// SIGTERM and SIGHUP stop the stage first. `command` is what the file records as its origin.
// Throws std::runtime_error when nothing could be begun.
CaptureOutcome capture_once(const CaptureWords& words, const CaptureSetup& setup,
                            const std::string& command, Streams& streams);

}  // namespace viscard
