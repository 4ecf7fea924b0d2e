#pragma once

#include "models/maths/text_of_number.h"

#include <cmath>
#include <stdexcept>
#include <string>

namespace viscard {

// Throws std::invalid_argument with the text unless the condition holds.
inline void require(bool holds, const std::string& what) {
  if (!holds) throw std::invalid_argument(what);
}

// Throws "WHAT is VALUE UNIT; it must be EXPECTED" unless the condition holds for a finite value.
inline void require_value(bool holds, const std::string& what, double value,
                          const std::string& unit, const std::string& expected) {
  if (holds && std::isfinite(value)) return;
  throw std::invalid_argument(what + " is " + text_of(value) + (unit.empty() ? "" : " ") + unit +
                              "; it must be " + expected);
}
inline void require_positive(const std::string& what, double value, const std::string& unit = "") {
  require_value(value > 0.0, what, value, unit, "positive and finite");
}
inline void require_not_negative(const std::string& what, double value,
                                 const std::string& unit = "") {
  require_value(value >= 0.0, what, value, unit, "finite and not negative");
}

}  // namespace viscard
