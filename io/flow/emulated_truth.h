#pragma once

#include "models/experiment/emulated_specimen.h"

#include <string>

namespace viscard {

// Extension of the file beside a capture of an emulated rig that holds its truth.
inline constexpr const char* kTruthEnding = ".truth.json";

// The truth as JSON for the file beside the capture: the result that a fit of the run should find.
std::string json_from_truth(const EmulatedTruth& truth);

// Reads a truth file written by a user (TOML) or by `viscard capture --emulate` (JSON). Throws std::runtime_error naming
// the file.
EmulatedTruth truth_from_file(const std::string& path);

}  // namespace viscard
