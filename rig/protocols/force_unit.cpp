#include "rig/protocols/force_unit.h"

#include "models/maths/text_of_number.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string>
#include <utility>

namespace viscard {

std::optional<double> newtons_per_unit(std::string_view unit) {
  constexpr double kGravity = 9.80665;
  constexpr double kPound_kg = 0.45359237;
  static constexpr std::array<std::pair<const char*, double>, 13> kRows{
      {{"n", 1.0},
       {"mn", 1e-3},
       {"kn", 1e3},
       {"g", 1e-3 * kGravity},
       {"gf", 1e-3 * kGravity},
       {"kg", kGravity},
       {"kgf", kGravity},
       {"oz", kPound_kg / 16.0 * kGravity},
       {"ozf", kPound_kg / 16.0 * kGravity},
       {"lb", kPound_kg * kGravity},
       {"lbs", kPound_kg * kGravity},
       {"lbf", kPound_kg * kGravity},
       {"p", 1e-3 * kGravity}}};  // pond, on older gauges
  std::string word(trimmed(unit));
  if (word == "MN") return std::nullopt;  // no gauge has meganewtons, and mN would be off by 1e9
  std::transform(word.begin(), word.end(), word.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  for (const auto& [name, newtons] : kRows) {
    if (word == name) return newtons;
  }
  return std::nullopt;
}

}  // namespace viscard
