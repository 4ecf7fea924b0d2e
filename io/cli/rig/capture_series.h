#pragma once

#include "io/cli/rig/capture_setup.h"

#include <string>
#include <vector>

namespace viscard {

// One specimen of a series, and the file that its capture goes to.
struct SeriesStep {
  std::string specimen_file;  // empty: the emulated rig's own
  std::string out_file;
  std::string finished_file;  // a finished capture of it that is there already: nothing to do
};

// What a command line asks for: --out FILE for one specimen; for several --out is a folder, and the
// files in it are named by number and specimen file, 01_NAME.viscap. With --resume a specimen that
// has a finished capture is left alone, and one whose capture was interrupted gets another file
// beside it, NAME.2.viscap and so on: nothing is overwritten or carried on in the middle.
// Throws std::runtime_error when a capture is being written by another program.
std::vector<SeriesStep> series_from_words(const CaptureWords& words);

}  // namespace viscard
