#include "io/config/quantity_text.h"

#include "io/basics/units.h"
#include "models/maths/text_of_number.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <stdexcept>

namespace viscard {
namespace {

constexpr const char* kExample = "write it like \"40 um +- 1 um\" or \"1.8 MPa +- 5 %\"";

bool has_unit_in(const std::string& text) {
  return text.find_first_not_of("0123456789+-.eE \t") != std::string::npos;
}

// Takes the word for the distribution off the end.
Spread take_spread(std::string& text) {
  for (const Spread spread : {Spread::kNormal, Spread::kLognormal, Spread::kUniform}) {
    const std::string word = std::string(" ") + name_of(spread);
    if (text.size() <= word.size()) continue;
    if (text.compare(text.size() - word.size(), word.size(), word) != 0) continue;
    text.resize(text.size() - word.size());
    return spread;
  }
  return Spread::kNormal;
}

// What is wrong with a last word that neither is a distribution nor can be a unit; empty if there is none.
std::string distribution_mistake(const std::string& right) {
  constexpr std::size_t kLongestUnit = 3;  // of those with only letters that may end a product
  const std::size_t at = right.find_last_of(" \t");
  if (at == std::string::npos) return "";
  const std::string word = right.substr(at + 1);
  const bool is_word =
      std::all_of(word.begin(), word.end(), [](unsigned char c) { return std::isalpha(c) != 0; });
  if (!is_word || word.size() <= kLongestUnit) return "";
  return "\"" + word +
         "\" is no distribution; allowed are normal (the default), lognormal and uniform";
}

// Half-width in SI; `value` is what a percentage refers to.
double half_width_from(const std::string& text, const char* unit, double value) {
  const std::string trimmed_text(trimmed(text));
  if (!trimmed_text.empty() && trimmed_text.back() == '%') {
    if (std::string(unit) == "degC") {
      throw std::invalid_argument(
          "a temperature has no percentage, whose zero would depend on its "
          "unit; give the width as a difference, such as +- 2 K");
    }
    const std::string number = trimmed_text.substr(0, trimmed_text.size() - 1);
    return 0.01 * si_from_text(number, "1") * std::abs(value);
  }
  const bool is_temperature = std::string(unit) == "degC";  // a difference has no zero point
  const double at_0 = is_temperature ? si_from_text("0 K", unit) : 0.0;
  const bool is_kelvin = is_temperature && trimmed_text.find('K') != std::string::npos;
  return quantity_from_text(trimmed_text, unit) - (is_kelvin ? at_0 : 0.0);
}

}  // namespace

double quantity_from_text(const std::string& text, const char* unit) {
  const double value = si_from_text(text, unit);
  if (!has_unit_in(text) && std::string(unit) != "1") {
    throw std::invalid_argument("\"" + text + "\" has no unit; write it with one, such as \"" +
                                text + " " + unit + "\", or without the quotes if it is in " +
                                unit);
  }
  return value;
}

std::optional<UncertainNumber> uncertain_from_text(const std::string& text, const char* unit) {
  std::size_t at = std::string::npos, length = 0;
  for (const std::string sign : {"+-", "+/-", "±"}) {
    at = text.find(sign);
    length = sign.size();
    if (at != std::string::npos) break;
  }
  if (at == std::string::npos) return std::nullopt;
  std::string left(trimmed(text.substr(0, at)));
  std::string right(trimmed(text.substr(at + length)));
  UncertainNumber number;
  number.spread = take_spread(right);
  const bool is_percent = !right.empty() && right.back() == '%';
  if (!is_percent && !has_unit_in(left) && has_unit_in(right)) {  // "40 +- 1 um"
    left += " " + right.substr(right.find_first_not_of("0123456789+-.eE \t"));
  }
  try {
    number.value = quantity_from_text(left, unit);
    number.half_width = half_width_from(right, unit, number.value);
    validate(number);
  } catch (const std::invalid_argument& error) {
    const std::string mistake = distribution_mistake(right);
    throw std::invalid_argument("\"" + text + "\": " + (mistake.empty() ? error.what() : mistake) +
                                "; " + kExample);
  }
  return number;
}

}  // namespace viscard
