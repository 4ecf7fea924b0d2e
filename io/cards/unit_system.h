#pragma once

#include <string>
#include <vector>

namespace viscard {

// A consistent set of units for a card. Every conversion is a power of ten. It is stored as its
// exponent, and a negative one divides, so that 965 kg/m3 becomes exactly the double 9.65e-10
// t/mm3.
//   number in the card = SI number * 10^exponent
struct UnitSystem {
  const char* name;         // as on the command line: "mm-t-s"
  const char* description;  // "mm, t, s, N, MPa, t/mm3"
  const char* stress;       // unit names for headers, tables and COMSOL expressions
  const char* time;
  const char* density;
  const char* mass;  // /UNIT block of OpenRadioss
  const char* length;
  int length_exponent;
  int stress_exponent;
  int time_exponent;
  int density_exponent;
};

// SI, mm-t-s, mm-kg-ms, mm-g-ms, um-kg-s, cgs.
const std::vector<UnitSystem>& unit_systems();

// nullptr when there is none of that name.
const UnitSystem* find_unit_system(const std::string& name);
// Throws std::invalid_argument listing the systems.
const UnitSystem& unit_system(const std::string& name);

// A unit in COMSOL's syntax: "MPa", "t/mm^3".
std::string comsol_unit(std::string unit);

// SI to card and back.
double to_card(double value_SI, int exponent);
double from_card(double value, int exponent);

}  // namespace viscard
