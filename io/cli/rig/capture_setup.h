#pragma once

#include "io/flow/capture_to_file.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace viscard {

// The options of `viscard capture`.
struct CaptureWords {
  std::optional<std::string> rig_file, test_file, truth_file;
  std::vector<std::string> specimen_files;  // in the order of the captures
  std::string out_file;                     // a folder if there are several specimens
  bool is_emulated = false;
  std::optional<std::uint64_t> seed;
  double speed = 1.0;
  bool overwrite = false;
  bool as_json = false;
  bool resumes = false;          // skip specimens with a finished capture
  bool asks_nobody = false;      // no prompt between specimens
  bool shows_page = false;       // --live
  bool is_uncalibrated = false;  // accept an expired calibration
  bool acknowledges = false;     // report on stderr how many records are safe
};

// Throws UsageError on options that cannot be combined.
void check_words(const CaptureWords& words);

// The setup for one specimen (empty: the emulated rig's own). Throws std::runtime_error on a bad
// file.
CaptureSetup capture_setup(const CaptureWords& words, const std::string& specimen_file);

}  // namespace viscard
