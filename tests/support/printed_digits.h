#pragma once

#include <catch2/catch.hpp>

#include <cmath>
#include <string>

namespace viscard::test {

// A number as it was printed, "1.4816453" or "3.875785e-5". A value is equal to it if it differs by
// at most half a unit of the last digit, or by `last` units if the printed number is uncertain.
// `unit` is the unit of the printed number ("7.058807" mV: 1e-3).
inline Catch::Detail::Approx printed(const std::string& text, double unit = 1.0,
                                     double last = 0.5) {
  const std::size_t exponent_at = text.find_first_of("eE");
  const std::size_t point_at = text.find('.');
  int decimals = 0;
  if (point_at != std::string::npos)
    decimals = static_cast<int>(text.substr(0, exponent_at).size() - point_at - 1);
  const int exponent =
      exponent_at == std::string::npos ? 0 : std::stoi(text.substr(exponent_at + 1));
  const double digit = std::pow(10.0, exponent - decimals) * unit;
  const double value = std::stod(text) * unit;
  // Exactly half a unit may be rounded up or down.
  return Catch::Detail::Approx(value).epsilon(0.0).margin(last * digit + 1e-15 * std::abs(value));
}

}  // namespace viscard::test
