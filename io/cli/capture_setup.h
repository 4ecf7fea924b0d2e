#pragma once

#include "models/emulated_specimen.h"
#include "models/rig_config.h"
#include "models/specimen.h"
#include "models/test_plan.h"

#include <cstdint>
#include <optional>
#include <string>

namespace viscard {

// Words of `viscard capture`, as given.
struct CaptureWords {
  std::optional<std::string> rig_file, test_file, specimen_file, truth_file;
  std::string out_file;
  bool is_emulated = false;
  std::optional<std::uint64_t> seed;
  double speed = 1.0;
  bool overwrite = false;
  bool as_json = false;
};

// Everything a run needs to know, read from files or, for an emulated rig, made up where files are
// left out.
struct CaptureSetup {
  RigConfig rig;
  TestPlan plan;
  Specimen specimen;
  std::optional<EmulatedTruth> truth;  // of an emulated rig
};

// Throws UsageError on words that do not go together, std::runtime_error on files.
CaptureSetup capture_setup(const CaptureWords& words);

// The truth as JSON, to lie beside the capture: what a fit of the run should find.
std::string json_from_truth(const EmulatedTruth& truth);

}  // namespace viscard
