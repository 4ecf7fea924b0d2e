#pragma once

#include "io/flow/predict_file.h"
#include "io/options/option.h"

#include <optional>
#include <string>
#include <vector>

namespace viscard {

// The options of `viscard predict` as a user gives them; `viscard predict --help` explains each.
// Quantities are texts with a unit ("10 kPa"), or numbers in SI.
struct PredictWords {
  using Text = std::optional<std::string>;
  Text test, strain, stress, ramp, hold, recovery, period, from, to, history, driven_by, against;
  Text time_zero, temperature, plausible, modulus_kind;
  std::optional<int> cycles, points;
  std::vector<std::string> column;
  bool unverified = false;
};
// Its options.
OptionList options_of(PredictWords& words);

// material: path of a material file; may be empty for predict_material(). Throws OptionError for a
// value that is not allowed and for options that contradict the test.
PredictFileRequest predict_request(const PredictWords& words, const std::string& material);

}  // namespace viscard
