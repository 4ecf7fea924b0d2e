#pragma once

#include "io/cli/rig/capture_setup.h"
#include "io/cli/words/streams.h"
#include "rig/run/run_outcome.h"

#include <string>
#include <vector>

namespace viscard {

// Extension of the live page beside a capture.
inline constexpr const char* kPageEnding = ".live.html";

// How one capture ended, and its forces for the summary.
struct CaptureOutcome {
  RunOutcome run;
  std::string file;
  std::vector<double> force_N;  // thinned out
};

// capture_to_file() with a live view on the terminal and, if asked for, a page. SIGINT, SIGTERM and
// SIGHUP first stop the stage.
CaptureOutcome capture_once(const CaptureWords& words, const CaptureSetup& setup,
                            const std::string& command, Streams& streams);

}  // namespace viscard
