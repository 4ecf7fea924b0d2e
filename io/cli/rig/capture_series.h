#pragma once

#include "io/cli/rig/capture_setup.h"

#include <string>
#include <vector>

namespace viscard {

// One specimen of a series and the file of its capture.
struct SeriesStep {
  std::string specimen_file;  // empty: the emulated rig's own
  std::string out_file;
  std::string finished_file;  // an existing finished capture of it; then there is nothing to do
};

// The captures that a command line asks for. For one specimen --out is the file; for several it is
// a folder, and the files in it are named by number and specimen file, 01_NAME.viscap. With
// --resume a specimen with a finished capture is skipped, and one whose capture was interrupted
// gets another file beside it, NAME.2.viscap and so on: nothing is overwritten or continued in the
// middle. Throws std::runtime_error if another program is writing one of the captures.
std::vector<SeriesStep> series_from_words(const CaptureWords& words);

}  // namespace viscard
