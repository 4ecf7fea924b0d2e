#pragma once

#include <string>

namespace viscard {

// The value that a publication prints for one result of a scene. Commands print it beside ours.
struct PrintedValue {
  std::string name;   // of a result, or family and number of a mode: "lateral 2"
  std::string value;  // with its unit: "16103 Hz"
  std::string note;   // why our value differs
};

}  // namespace viscard
