#include "io/cards/unit_system.h"

#include "io/basics/words.h"

#include <cmath>
#include <stdexcept>

namespace viscard {

const std::vector<UnitSystem>& unit_systems() {
  // Stress is mass/(length time^2), density mass/length^3.
  static const std::vector<UnitSystem> table{
      {"SI", "m, kg, s, N, Pa, kg/m3", "Pa", "s", "kg/m3", "kg", "m", 0, 0, 0, 0},
      {"mm-t-s", "mm, t, s, N, MPa, t/mm3", "MPa", "s", "t/mm3", "Mg", "mm", 3, -6, 0, -12},
      {"mm-kg-ms", "mm, kg, ms, kN, GPa, kg/mm3", "GPa", "ms", "kg/mm3", "kg", "mm", 3, -9, 3, -9},
      {"mm-g-ms", "mm, g, ms, N, MPa, g/mm3", "MPa", "ms", "g/mm3", "g", "mm", 3, -6, 3, -6},
      {"um-kg-s", "um, kg, s, uN, MPa, kg/um3", "MPa", "s", "kg/um3", "kg", "mum", 6, -6, 0, -18},
      {"cgs", "cm, g, s, dyn, Ba, g/cm3", "Ba", "s", "g/cm3", "g", "cm", 2, 1, 0, -3},
  };
  return table;
}

const UnitSystem* find_unit_system(const std::string& name) {
  for (const UnitSystem& system : unit_systems()) {
    if (name == system.name) return &system;
  }
  return nullptr;
}

const UnitSystem& unit_system(const std::string& name) {
  if (const UnitSystem* found = find_unit_system(name)) return *found;
  std::vector<std::string> names;
  for (const UnitSystem& system : unit_systems()) names.emplace_back(system.name);
  throw std::invalid_argument(no_such_word("unit system", name, names));
}

std::string comsol_unit(std::string unit) {
  if (unit == "Ba") return "dyn/cm^2";
  if (unit.back() == '3') unit.insert(unit.size() - 1, "^");
  return unit;
}

double to_card(double value_SI, int exponent) {
  return exponent < 0 ? value_SI / std::pow(10.0, -exponent) : value_SI * std::pow(10.0, exponent);
}

double from_card(double value, int exponent) {
  return to_card(value, -exponent);
}

}  // namespace viscard
