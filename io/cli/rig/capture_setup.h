#pragma once

#include "models/experiment/emulated_specimen.h"
#include "models/experiment/rig_config.h"
#include "models/experiment/specimen.h"
#include "models/experiment/test_plan.h"

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

// All that one run needs, read from files; an emulated rig has defaults for files that are left
// out.
struct CaptureSetup {
  RigConfig rig;
  TestPlan plan;
  Specimen specimen;
  std::optional<EmulatedTruth> truth;  // of an emulated rig
};

// Throws UsageError on options that cannot be combined.
void check_words(const CaptureWords& words);

// The setup for one specimen (empty: the emulated rig's own). Throws std::runtime_error on a bad
// file.
CaptureSetup capture_setup(const CaptureWords& words, const std::string& specimen_file);

// The truth as JSON for the file beside the capture: the result that a fit of the run should find.
std::string json_from_truth(const EmulatedTruth& truth);

}  // namespace viscard
