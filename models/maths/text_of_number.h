#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <string>

namespace viscard {

// A number as a person reads it in a message: "1e-14", "0.495", "nan". std::to_string would print
// the first as 0.000000.
inline std::string text_of(double value, int significant_digits = 6) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.*g", significant_digits, value);
  return text.data();
}

// As many digits as the standard error allows, two of its own: 18.76 +- .83 becomes "18.76", and
// 2.17e-3 of an error of 5e-4 "0.00217". Six digits where there is no error.
inline std::string text_with_error(double value, double standard_error) {
  if (!(standard_error > 0.0) || !std::isfinite(standard_error) || value == 0.0) {
    return text_of(value);
  }
  const double digits =
      std::floor(std::log10(std::abs(value))) - std::floor(std::log10(standard_error)) + 2.0;
  return text_of(value, static_cast<int>(std::clamp(digits, 1.0, 15.0)));
}

// "1 term", "2 terms".
inline std::string counted(std::size_t count, const std::string& one) {
  return std::to_string(count) + " " + one + (count == 1 ? "" : "s");
}

}  // namespace viscard
