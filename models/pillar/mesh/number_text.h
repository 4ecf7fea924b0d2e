#pragma once

#include <cstdio>
#include <string>

namespace viscard {

// Text of a number for a message: at most `digits` digits, and small values as 1e-14, not 0.000000.
inline std::string number_text(double value, int digits = 6) {
  char text[32];
  std::snprintf(text, sizeof text, "%.*g", digits, value);
  return text;
}

}  // namespace viscard
