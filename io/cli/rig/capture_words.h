#pragma once

#include "io/cli/words/streams.h"
#include "io/flow/capture_to_file.h"
#include "models/quantities/plausible.h"
#include "rig/run/run_outcome.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace viscard {

// The options of `viscard capture`.
struct CaptureWords {
  std::optional<std::string> rig_file, test_file;
  std::vector<std::string> truth_files;     // one, or one for each specimen
  std::vector<std::string> specimen_files;  // in the order of the captures
  std::string out_file;                     // a folder for several specimens or repeats
  bool is_emulated = false;
  std::optional<std::uint64_t> seed;
  double speed = 1.0;
  std::optional<std::string> fault;   // of the emulated rig: frozen@hold+0.5
  int repeats = 1;                    // touches on each specimen
  std::optional<double> lift_wait_s;  // between two touches
  bool overwrite = false;
  bool as_json = false;
  bool resumes = false;          // skip specimens with a finished capture
  bool asks_nobody = false;      // no prompt between specimens
  bool shows_page = false;       // --live
  bool is_uncalibrated = false;  // accept an expired calibration
  bool lifts_at_start = false;   // --lift: lift a punch that presses before the test, then go on
  Plausible plausible = Plausible::kMeasured;  // kOff accepts any value in the files
  bool acknowledges = false;  // report on stderr how many records are safe, and from what
};

// Throws UsageError on options that cannot be combined.
void check_words(const CaptureWords& words);

// One specimen of a series, or one touch on it, and the file of its capture.
struct SeriesStep {
  std::string specimen_file;  // empty: the emulated rig's own
  std::string out_file;
  std::string finished_file;  // an existing finished capture of it; then there is nothing to do
  std::size_t specimen = 0;   // index
  int touch = 0;              // from 1; 0: the specimen is touched once
  int last_touch = 0;         // of this series
};

// The setup for one step. Throws std::runtime_error on a bad file.
CaptureSetup capture_setup(const CaptureWords& words, const SeriesStep& step);

// The captures that a command line asks for. For one specimen --out is the file; for several it is
// a folder, and the files in it are named by number and specimen file, 01_NAME.viscap. With --repeat
// they are 01_NAME_touch01.viscap and so on, numbered on behind those that are there. With --resume a specimen with a finished capture is skipped, and one whose capture was interrupted
// gets another file beside it, NAME.2.viscap and so on: nothing is overwritten or continued in the
// middle. Throws std::runtime_error if another program is writing one of the captures, or a finished one
// is of another test or specimen.
std::vector<SeriesStep> series_from_words(const CaptureWords& words);

// Waits before the next touch, while the punch is lifted; false if Ctrl-C or a signal ended the wait.
// An emulated rig waits shorter by its speed.
bool wait_lifted(const SeriesStep& step, const CaptureWords& words, Streams& streams);

// Extension of the live page beside a capture.
inline constexpr const char* kPageEnding = ".live.html";

// How one capture ended, and its forces for the summary.
struct CaptureOutcome {
  RunOutcome run;
  std::string file;
  std::vector<double> force_N;  // thinned out
};

// capture_to_file() with a live view on the terminal and, if asked for, a page. SIGINT, SIGTERM and
// SIGHUP first stop the stage. homing: of the series that the capture belongs to.
CaptureOutcome capture_once(const CaptureWords& words, const CaptureSetup& setup,
                            SeriesHoming& homing, const std::string& command, Streams& streams);

}  // namespace viscard
