#pragma once

#include <string_view>

namespace viscard {

// Units of user files and table headers, read with the UDUNITS-2 database (Unidata; unit names and
// factors follow NIST SP 811). All functions may be called from several threads, do not depend on
// the process's locale and print nothing.

// Value in SI = factor * value as written + offset. Only temperatures have an offset other than 0.
struct UnitScale {
  double factor = 1.0;
  double offset = 0.0;
};

// Returns the value of "40 um", "10 kPa", "0.7255 V/N" or "250 gf" in si_unit ("m", "Pa", "V/N",
// "N"). A number without a unit is in si_unit. With si_unit "degC" it accepts "23 C", "23 degC" and
// "296.15 K". Throws std::invalid_argument naming the text, the unit expected and an example.
// example: of the quantity, "1 %"; none or empty: one of the unit.
double si_from_text(std::string_view text, const char* si_unit, const char* example = nullptr);

// Returns the scale from unit_text ("ms", "MPa", "%") to si_unit. "", "-" and "1" mean no unit and
// give factor 1. Turns and radians differ: "rad/s" to "Hz" divides by 2 pi. Throws
// std::invalid_argument naming both units if they do not measure the same quantity.
UnitScale scale_to_si(std::string_view unit_text, const char* si_unit);

// True if scale_to_si() would succeed.
bool is_unit_of(std::string_view unit_text, const char* si_unit);

// The unit of that kind that differs from the text by capitals only, "MPa" for "Mpa"; empty: none.
std::string_view unit_in_right_case(std::string_view unit_text, const char* si_unit);

// True if the text is a unit of some quantity ("MPa", "s", "-").
bool is_unit(std::string_view unit_text);

}  // namespace viscard
