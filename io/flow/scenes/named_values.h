#pragma once

#include "models/answer/scene_answer.h"

#include <string>
#include <vector>

namespace viscard {

struct NamedValue {
  std::string name;  // of a result, or family and number of a mode: "lateral 2"
  double value = 0.0;
  std::string unit;
  double error_estimate = 0.0;  // of the computation, in the unit
};

// The results and the frequencies of the modes.
std::vector<NamedValue> named_values(const SceneAnswer& answer);

}  // namespace viscard
