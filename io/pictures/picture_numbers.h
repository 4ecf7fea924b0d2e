#pragma once

#include <string>

namespace viscard {

// Numbers as pictures show them: with a prefix of their unit, and with the minus sign (U+2212) that curves have.

// A unit and its factor: the largest prefix (G to p) that leaves 1 before the point of the largest value.
// Percentages, plain numbers and powers of a unit ("m^2") take none.
struct PrefixedUnit {
  double per_si = 1.0;
  std::string text;
};
PrefixedUnit prefixed_unit(const std::string& unit, double largest);

// "-1.5e-07" with minus signs in the place of hyphens.
std::string with_minus(const std::string& number);

// "173.7 kHz", "25 µm".
std::string in_unit(double value, const std::string& unit, int digits = 4);
// Both with the digits that the error allows, two of its own: "17.952 ± 0.010 kHz". Six digits if the error is not
// positive.
std::string in_unit_with_error(double value, double error, const std::string& unit);
// "−732.6 to −600.2 nm".
std::string interval_in_unit(double low, double high, const std::string& unit);

}  // namespace viscard
