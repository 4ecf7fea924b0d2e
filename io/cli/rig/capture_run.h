#pragma once

#include "io/cli/rig/capture_setup.h"
#include "io/cli/words/streams.h"
#include "rig/run_indentation.h"

#include <optional>
#include <string>
#include <vector>

namespace viscard {

// Extensions of the files beside a capture: the truth of an emulated rig, and the live page.
inline constexpr const char* kTruthEnding = ".truth.json";
inline constexpr const char* kPageEnding = ".live.html";

// How one capture ended, and its forces for the summary.
struct CaptureOutcome {
  RunOutcome run;
  std::string file;
  std::vector<double> force_N;  // thinned out
};

// Opens both ports (or makes an emulated rig), creates the file and runs one test. SIGINT, SIGTERM
// and SIGHUP first stop the stage. `command` is recorded in the file as its origin. Throws
// std::runtime_error if the test could not begin.
CaptureOutcome capture_once(const CaptureWords& words, const CaptureSetup& setup,
                            const std::string& command, Streams& streams);

}  // namespace viscard
