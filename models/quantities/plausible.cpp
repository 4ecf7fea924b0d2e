#include "models/quantities/plausible.h"

#include "models/maths/text_of_number.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string_view>

namespace viscard {
namespace {

struct OtherUnit {
  const char* si;
  const char* unit;
  double factor;  // SI per unit
};
// Units in which people write numbers.
constexpr OtherUnit kOtherUnits[] = {{"Pa", "MPa", 1e6},      {"Pa", "kPa", 1e3},
                                     {"Pa", "GPa", 1e9},      {"1/Pa", "1/MPa", 1e-6},
                                     {"1/Pa", "1/kPa", 1e-3}, {"1/Pa", "1/GPa", 1e-9},
                                     {"m", "mm", 1e-3},       {"m", "um", 1e-6},
                                     {"m", "nm", 1e-9},       {"N", "mN", 1e-3},
                                     {"N", "uN", 1e-6},       {"N", "kN", 1e3},
                                     {"N/m", "N/mm", 1e3},    {"N/m", "kN/mm", 1e6},
                                     {"kg/m3", "g/cm3", 1e3}, {"1", "%", 1e-2},
                                     {"s", "ms", 1e-3},       {"s", "us", 1e-6},
                                     {"s", "ns", 1e-9},       {"Hz", "kHz", 1e3},
                                     {"m/s", "mm/s", 1e-3},   {"m/s", "um/s", 1e-6},
                                     {"m/s2", "mm/s2", 1e-3}, {"V", "mV", 1e-3},
                                     {"kg", "g", 1e-3},       {"rad", "deg", 0.017453292519943295}};

bool has_prefixes(const std::string& unit) {
  return unit == "Pa" || unit == "m" || unit == "N" || unit == "V" || unit == "Hz" || unit == "F" ||
         unit == "ohm" || unit == "s";
}

bool is_in(const PlausibleRange& range, double value) {
  if (!std::isfinite(value)) return false;
  const double compared = range.lowest < 0.0 ? value : std::abs(value);
  // A limit that was computed or converted may be off by its last digit.
  const double slack = 1e-12 * std::abs(compared);
  return compared >= range.lowest - slack && compared <= range.highest + slack;
}

// The example of a quantity in SI: "2 MPa" gives 2e6.
double example_of(const Quantity& quantity) {
  const std::string text = quantity.example;
  const std::size_t blank = text.find(' ');
  const double number = number_from_text(text.substr(0, blank)).value_or(1.0);
  if (blank == std::string::npos) return number;
  for (const OtherUnit& other : kOtherUnits) {
    if (text.substr(blank + 1) == other.unit) return number * other.factor;
  }
  return number;
}

// The unit in which the number is plausible and nearest to the example of the quantity.
const OtherUnit* meant_unit(const Quantity& quantity, const PlausibleRange& range, double value) {
  const OtherUnit* found = nullptr;
  double least = 0.0;
  const bool is_percentage = std::string_view(quantity.example).ends_with('%');
  for (const OtherUnit& other : kOtherUnits) {
    const double meant = value * other.factor;
    // Nobody writes a Poisson ratio in per cent, and a stretch of 200 % is most often a strain.
    if (std::string_view(other.unit) == "%" && !is_percentage) continue;
    if (std::string(other.si) != quantity.unit || meant == 0.0 || !is_in(range, meant)) continue;
    const double off = std::abs(std::log(std::abs(meant / example_of(quantity))));
    if (found != nullptr && off >= least) continue;
    found = &other;
    least = off;
  }
  return found;
}

}  // namespace

Plausible plausible_from_word(const std::string& word, Plausible otherwise) {
  if (word == "on") return otherwise;
  if (word == "off") return Plausible::kOff;
  throw std::invalid_argument("plausible is '" + word +
                              "'; use on (the default), or off to accept any value");
}

std::string text_with_unit(double value, const std::string& unit) {
  constexpr double kDay_s = 86400.0;
  if (unit == "s" && std::abs(value) >= kDay_s && std::abs(value) < 1e9) {
    return text_of(value / kDay_s, 4) + " days";
  }
  if (value == 0.0 || unit == "1") return text_of(value);
  if (!has_prefixes(unit) || (unit == "s" && value > 1.0) || (unit == "m" && value > 1.0)) {
    return text_of(value) + " " + unit;
  }
  constexpr const char* kPrefixes[] = {"f", "p", "n", "u", "m", "", "k", "M", "G", "T"};
  constexpr int kNone = 5;
  const int thousands =
      std::clamp(static_cast<int>(std::floor((std::log10(std::abs(value)) + 1e-9) / 3.0)), -kNone,
                 static_cast<int>(std::size(kPrefixes)) - 1 - kNone);
  return text_of(value / std::pow(1000.0, thousands)) + " " + kPrefixes[thousands + kNone] + unit;
}

std::string Doubt::text() const {
  if (!sign.empty()) return "is " + value_text + "; " + sign;
  return "is " + value_text + "; plausible are " + range + " (" + reason + ")";
}

std::string Doubt::with_remedy(const std::string& write_meant, const std::string& accept) const {
  if (!sign.empty()) return text();
  if (meant.empty()) {
    return text() + ". Is its unit missing or wrong? If the value is right, " + accept;
  }
  return text() + ". If " + meant + " was meant, " + write_meant + "; if the value is right, " +
         accept;
}

namespace {

Doubt doubt_of(const Quantity& quantity, double value) {
  const std::string unit = quantity.unit;
  Doubt doubt;
  doubt.value = value;
  doubt.value_text = text_of(value) + (unit == "1" ? "" : " " + unit);
  return doubt;
}

// Of the size of a number of either sign.
std::optional<Doubt> doubt_about_size(const Quantity& quantity, double value, Plausible judged) {
  const PlausibleRange& range = judged == Plausible::kScene ? quantity.scene : quantity.measured;
  if (is_in(range, value)) return std::nullopt;
  const std::string unit = quantity.unit;
  Doubt doubt = doubt_of(quantity, value);
  doubt.range = text_with_unit(range.lowest, unit) + " to " + text_with_unit(range.highest, unit);
  doubt.reason = judged == Plausible::kScene ? "for a " + std::string(quantity.name) + " in a scene"
                                             : quantity.reason;
  if (const OtherUnit* other = meant_unit(quantity, range, value)) {
    doubt.meant = text_of(value) + " " + other->unit;
    doubt.meant_factor = other->factor;
  } else {
    doubt.range += ", such as " + std::string(quantity.example);
  }
  return doubt;
}

}  // namespace

std::optional<Doubt> doubt_about_sign(const Quantity& quantity, double value) {
  const bool is_wrong =
      value < 0.0 ? quantity.sign != Sign::kAny
                  : value == 0.0 && quantity.sign == Sign::kPositive && !quantity.zero_is_none;
  if (!is_wrong || !std::isfinite(value)) return std::nullopt;
  Doubt doubt = doubt_of(quantity, value);
  doubt.sign = quantity.sign == Sign::kPositive ? "it must be positive" : "it must not be negative";
  return doubt;
}

std::optional<Doubt> doubt_about(const Quantity& quantity, double value, Plausible judged) {
  if (judged == Plausible::kOff || !std::isfinite(value)) return std::nullopt;
  if (value == 0.0 && quantity.zero_is_none) return std::nullopt;
  if (auto doubt = doubt_about_sign(quantity, value)) return doubt;
  return doubt_about_size(quantity, value, judged);
}

std::optional<Doubt> doubt_about(const Quantity& quantity, const std::vector<double>& values,
                                 Plausible judged) {
  if (judged == Plausible::kOff) return std::nullopt;
  if (quantity.kind == QuantityKind::kEach) {
    for (const double value : values) {
      if (!std::isfinite(value) || (value == 0.0 && quantity.zero_is_none)) continue;
      if (value < 0.0 && quantity.sign != Sign::kAny) return doubt_about_sign(quantity, value);
      if (auto doubt = doubt_about_size(quantity, value, judged)) return doubt;
    }
    return std::nullopt;
  }
  double largest = 0.0;
  bool has_positive = false;
  for (const double value : values) {
    if (std::isfinite(value) && std::abs(value) > std::abs(largest)) largest = value;
    has_positive |= value > 0.0;
  }
  if (largest == 0.0) return std::nullopt;  // it measures nothing; its reader says so
  auto doubt = doubt_about_size(quantity, largest, judged);
  const auto wrong_sign = doubt_about_sign(quantity, largest);
  if (doubt && wrong_sign && !has_positive) {
    doubt->sign = wrong_sign->sign;
    doubt->meant_factor *= -1.0;
  }
  return doubt;
}

}  // namespace viscard
