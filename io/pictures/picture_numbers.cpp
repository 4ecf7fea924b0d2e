#include "io/pictures/picture_numbers.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <system_error>
#include <utility>

namespace viscard {
namespace {

bool takes_prefix(const std::string& unit) {
  if (unit.starts_with("kg") || unit.starts_with("deg")) return false;
  const auto is_letter = [](char c) { return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z'); };
  const auto end = std::find_if_not(unit.begin(), unit.end(), is_letter);
  return end != unit.begin() && (end == unit.end() || *end == '/' || *end == ' ');
}

std::string number_of(double value, int digits) {
  return with_minus(fmt::format("{:.{}g}", value, digits));
}

// 999.96 with four digits is 1000, whose prefix is another one.
double rounded(double value, int digits) {
  if (!std::isfinite(value)) return value;
  const std::string text = fmt::format("{:.{}e}", value, digits - 1);
  double number = value;
  std::from_chars(text.data(), text.data() + text.size(), number);
  return number;
}

std::string before_unit(const PrefixedUnit& unit) {
  return unit.text.empty() ? "" : " " + unit.text;
}

}  // namespace

PrefixedUnit prefixed_unit(const std::string& unit, double largest) {
  if (unit == "1") return {};
  if (!takes_prefix(unit) || !(largest > 0.0)) return {1.0, unit};
  constexpr std::array<std::pair<double, const char*>, 7> kPrefixes = {
      {{1e9, "G"}, {1e6, "M"}, {1e3, "k"}, {1.0, ""}, {1e-3, "m"}, {1e-6, "µ"}, {1e-9, "n"}}};
  for (const auto& [size, letter] : kPrefixes) {
    // A whole number of small units may be less by rounding: 25 x 1e-6.
    if (largest >= size * (1.0 - 1e-12)) return {1.0 / size, letter + unit};
  }
  return {1e12, "p" + unit};
}

std::string with_minus(const std::string& number) {
  std::string text;
  for (const char c : number) text += c == '-' ? "\u2212" : std::string(1, c);
  return text;
}

std::string in_unit(double value, const std::string& unit, int digits) {
  const double short_value = rounded(value, digits);
  const PrefixedUnit shown = prefixed_unit(unit, std::abs(short_value));
  constexpr int kWithoutExponent = 6;
  return number_of(shown.per_si * short_value, std::max(digits, kWithoutExponent)) +
         before_unit(shown);
}

std::string in_unit_with_error(double value, double error, const std::string& unit) {
  if (!(error > 0.0) || !std::isfinite(error)) return in_unit(value, unit, 6);
  const PrefixedUnit shown = prefixed_unit(unit, std::max(std::abs(value), error));
  constexpr int kMost = 9;
  const double digit = std::floor(std::log10(shown.per_si * error));  // place of its first one
  if (1.0 - digit > kMost) {
    return in_unit(value, unit, kMost) + fmt::format(" ± {:.1e}", shown.per_si * error) +
           before_unit(shown);
  }
  const int decimals = static_cast<int>(std::max(1.0 - digit, 0.0));
  return with_minus(fmt::format("{:.{}f}", shown.per_si * value, decimals)) +
         fmt::format(" ± {:.{}f}", shown.per_si * error, decimals) + before_unit(shown);
}

std::string interval_in_unit(double low, double high, const std::string& unit) {
  const PrefixedUnit shown = prefixed_unit(unit, std::max(std::abs(low), std::abs(high)));
  return number_of(shown.per_si * low, 4) + " to " + number_of(shown.per_si * high, 4) +
         before_unit(shown);
}

}  // namespace viscard
