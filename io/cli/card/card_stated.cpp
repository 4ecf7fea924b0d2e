#include "io/cards/card_lines.h"
#include "io/cards/material_difference.h"
#include "io/cli/card/card_words.h"
#include "models/maths/text_of_number.h"

#include <fmt/format.h>

namespace viscard {
namespace {

// What follows the mark in the text, up to the end mark; "" if one of them is not there.
std::string between(const std::string& text, const std::string& mark, const std::string& end) {
  const std::size_t at = text.find(mark);
  if (at == std::string::npos) return "";
  const std::size_t begin = at + mark.size(), stop = text.find(end, begin);
  const std::size_t line = text.find('\n', begin);
  return stop == std::string::npos || stop > line ? "" : text.substr(begin, stop - begin);
}

// The words of the header are those of card_header.cpp, write_card.cpp and card_material.cpp.
CardWords with_stated_options(const std::string& card, const CardWords& words,
                              std::vector<std::string>& stated) {
  CardWords asked = words;
  const std::string refitted = between(card, "terms: approximated, ", ", E(t) within");
  const std::size_t count = refitted.find(" refitted to ");
  if (!words.may_approximate && count != std::string::npos) {
    asked.terms = static_cast<int>(integer_from_text(refitted.substr(count + 13)).value_or(1));
    asked.may_approximate = true;
    stated.push_back("terms " + refitted);
  }
  const std::string kept = between(card, " relaxation terms left out, the ", " modulus kept");
  if (words.elastic_only.empty() && (kept == "instantaneous" || kept == "long-term")) {
    asked.elastic_only = kept;
    stated.push_back("the " + kept + " modulus alone");
  }
  const std::string clamped = between(card, "nu: approximated, clamped from ", "\n");
  if (!words.clamped_nu && clamped.find(" to ") != std::string::npos) {
    asked.clamped_nu = number_from_text(std::string(trimmed(between(clamped + " ", " to ", " "))));
    stated.push_back("nu clamped from " + clamped);
  }
  const std::string end = between(card, "bound: E0 ", " end of the 95 % interval");
  if (words.bound.empty() && !end.empty()) {
    asked.bound = end.find("lower") != std::string::npos ? "lower" : "upper";
    stated.push_back("the " + asked.bound + " bound");
  }
  const std::string only = between(card, "temperature: the card holds at ", " C only; the times");
  if (!words.temperature_C && !only.empty()) {
    asked.temperature_C = number_from_text(only);
    stated.push_back("at " + only + " C");
  }
  return asked;
}

}  // namespace

PreparedMaterial stated_material(const std::string& card, const CardWords& words,
                                 std::vector<CardFinding>& notes) {
  std::vector<std::string> stated;
  const CardWords asked = with_stated_options(card, words, stated);
  PreparedMaterial prepared = prepared_material(asked);
  Material& material = prepared.material;
  if (asked.clamped_nu && material.nu > *asked.clamped_nu) material.nu = *asked.clamped_nu;
  if (stated.empty()) return prepared;
  std::string text;
  for (const std::string& item : stated) text += (text.empty() ? "" : "; ") + item;
  const Material original = prepared_material(words).material;
  notes.push_back(
      {"as-stated",
       fmt::format("compared with what the header states: {}; E(t) of that is within {:.2e} of the "
                   "material's",
                   text, largest_E_difference(material, original, comparison_times_s(original))),
       false});
  return prepared;
}

}  // namespace viscard
