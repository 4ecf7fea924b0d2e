#pragma once

#include <array>
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

// "1 term", "2 terms".
inline std::string counted(std::size_t count, const std::string& one) {
  return std::to_string(count) + " " + one + (count == 1 ? "" : "s");
}

}  // namespace viscard
