#include "rig/protocols/temperature_text.h"

#include "models/maths/text_of_number.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

namespace viscard {
namespace {

constexpr double kLowest_C = -200.0, kHighest_C = 1000.0;
constexpr double kDisconnected_C = -127.0;

std::string lower_text(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return result;
}

// "degC" for "C", "deg C", "celsius" and a degree sign with C; empty for what is no unit.
std::string known_unit(std::string_view text) {
  std::string word;
  for (const char c : lower_text(text)) {
    if (std::isalpha(static_cast<unsigned char>(c)) != 0) word += c;  // the degree sign is dropped
  }
  static constexpr std::array<std::pair<const char*, const char*>, 8> kWords{
      {{"c", "degC"},
       {"degc", "degC"},
       {"celsius", "degC"},
       {"f", "degF"},
       {"degf", "degF"},
       {"fahrenheit", "degF"},
       {"k", "K"},
       {"kelvin", "K"}}};
  for (const auto& [name, unit] : kWords) {
    if (word == name) return unit;
  }
  return "";
}

double celsius_from(double value, const std::string& unit) {
  if (unit == "degF") return (value - 32.0) / 1.8;
  return unit == "K" ? value - 273.15 : value;
}

// What stands behind the name and its sign, "=" or ":"; the whole text without a name.
std::string_view behind_name(std::string_view text) {
  const std::size_t sign = text.find_first_of("=:");
  return sign == std::string_view::npos ? text : trimmed(text.substr(sign + 1));
}

}  // namespace

bool is_temperature_unit(std::string_view unit) {
  return unit == "degC" || unit == "degF" || unit == "K";
}

bool names_temperature(std::string_view line) {
  const std::string text = lower_text(trimmed(line));
  const std::size_t sign = text.find_first_of("=:");
  if (sign == std::string::npos) return false;
  const std::string_view name = trimmed(std::string_view(text).substr(0, sign));
  return name == "t" || name.rfind("temp", 0) == 0;
}

std::optional<double> temperature_C_from_text(std::string_view line, const std::string& unit) {
  std::string_view text = trimmed(line);
  if (text.find_first_of("=:") != std::string_view::npos && !names_temperature(text)) {
    return std::nullopt;
  }
  text = behind_name(text);
  // Of several numbers the first one counts: "23.41,45.2" has a humidity too.
  text = trimmed(text.substr(0, text.find_first_of(",;\t")));
  std::size_t end = text.find_first_not_of("+-0123456789.");
  if (end != std::string_view::npos && end > 0 && (text[end] == 'E' || text[end] == 'e')) {
    end = text.find_first_not_of("+-0123456789", end + 1);
  }
  const auto value = number_from_text(text.substr(0, end));
  if (!value) return std::nullopt;
  std::string of_value = unit;
  if (end != std::string_view::npos) {
    const std::string_view rest = trimmed(text.substr(end));
    of_value = known_unit(rest.substr(0, rest.find(' ')));
    if (of_value.empty()) return std::nullopt;
  }
  const double temperature_C = celsius_from(*value, of_value);
  const bool is_reading =
      temperature_C >= kLowest_C && temperature_C <= kHighest_C && temperature_C != kDisconnected_C;
  return is_reading ? std::optional(temperature_C) : std::nullopt;
}

}  // namespace viscard
