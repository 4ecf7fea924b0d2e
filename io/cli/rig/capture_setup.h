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

// Words of `viscard capture`, as given.
struct CaptureWords {
  std::optional<std::string> rig_file, test_file, truth_file;
  std::vector<std::string> specimen_files;  // one after the other
  std::string out_file;                     // a folder if there are several specimens
  bool is_emulated = false;
  std::optional<std::uint64_t> seed;
  double speed = 1.0;
  bool overwrite = false;
  bool as_json = false;
  bool resumes = false;          // leave out what is finished already
  bool asks_nobody = false;      // no prompt between specimens
  bool shows_page = false;       // --live
  bool is_uncalibrated = false;  // an expired calibration will do
  bool acknowledges = false;     // say on stderr how many records are safe
};

// Everything a run needs to know, read from files or, for an emulated rig, made up where files are
// left out.
struct CaptureSetup {
  RigConfig rig;
  TestPlan plan;
  Specimen specimen;
  std::optional<EmulatedTruth> truth;  // of an emulated rig
};

// Throws UsageError on words that do not go together.
void check_words(const CaptureWords& words);

// For one of the specimens (empty: the emulated rig's own). Throws std::runtime_error on files.
CaptureSetup capture_setup(const CaptureWords& words, const std::string& specimen_file);

// The truth as JSON, to lie beside the capture: what a fit of the run should find.
std::string json_from_truth(const EmulatedTruth& truth);

}  // namespace viscard
