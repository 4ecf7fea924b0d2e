#include "io/cards/card_form.h"

#include "io/cards/card_header.h"
#include "io/cards/card_lines.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <iterator>
#include <vector>

namespace viscard {
namespace {

// Words, numbers and signs of a line; numbers to nine digits, so that their notation is free.
std::string form_of(const std::string& line, bool is_case_sensitive) {
  std::string out;
  std::string word;
  const auto add_word = [&] {
    if (word.empty()) return;
    const auto value = number_from_text(word);
    out += value ? fmt::format("{:.9g}", *value == 0.0 ? 0.0 : *value)
                 : (is_case_sensitive ? word : upper(word));
    out += ' ';
    word.clear();
  };
  for (const char c : line) {
    const auto byte = static_cast<unsigned char>(c);
    if (std::isalnum(byte) != 0 || c == '.' || c == '-' || c == '+' || c == '_') {
      word += c;
      continue;
    }
    add_word();
    if (std::isspace(byte) == 0) out += std::string(1, c) + ' ';
  }
  add_word();
  return out;
}

struct FormLine {
  CardLine line;
  std::string form;
};

std::vector<FormLine> form_lines(const std::string& text, const CardTarget& target) {
  std::vector<FormLine> out;
  const std::string comment = target.comment.empty() ? "\n" : target.comment;
  // The header of a JSON card is a list at its end.
  const std::size_t header = target.comment.empty() ? text.find("\"header\"") : std::string::npos;
  for (const CardLine& line : card_lines(text.substr(0, header), comment)) {
    const std::string form = form_of(line.text, target.is_case_sensitive);
    if (form.empty()) continue;
    const std::size_t indent = target.is_indented ? line.text.find_first_not_of(' ') : 0;
    out.push_back({line, fmt::format("{} {}", indent, form)});
  }
  return out;
}

std::optional<CardFinding> first_difference(const std::string& text, const std::string& expected,
                                            const CardTarget& target) {
  const std::vector<FormLine> found = form_lines(text, target),
                              wanted = form_lines(expected, target);
  if (wanted.empty()) return std::nullopt;
  const auto differs = [&](const std::string& where) {
    // Such a card is a program: other lines compute something else.
    return CardFinding{"form-differs", where, target.is_indented};
  };
  // A line that viscard writes once and the card has twice was doubled by hand.
  const auto is_doubled = [&](std::vector<FormLine>::const_iterator line) {
    return line != found.begin() && line->form == std::prev(line)->form;
  };
  const auto doubled = [&](const FormLine& line) {
    return CardFinding{"doubled-line",
                       at_line(line.line, "'" + std::string(trimmed(line.line.text)) +
                                              "' stands in the card twice; delete one of them"),
                       true};
  };
  auto at = std::find_if(found.begin(), found.end(),
                         [&](const FormLine& line) { return line.form == wanted.front().form; });
  for (const FormLine& line : wanted) {
    const std::string text_wanted(trimmed(line.line.text));
    if (at == found.end()) return differs("the line '" + text_wanted + "' is missing");
    if (at->form != line.form) {
      if (is_doubled(at)) return doubled(*at);
      return differs(at_line(at->line, "'" + std::string(trimmed(at->line.text)) +
                                           "' where viscard writes '" + text_wanted + "'"));
    }
    ++at;
  }
  if (at == found.end()) return std::nullopt;
  if (is_doubled(at)) return doubled(*at);
  if (!target.is_indented) return std::nullopt;  // a model may follow the card
  return differs(at_line(at->line, "'" + std::string(trimmed(at->line.text)) +
                                       "' is not of the card that viscard writes"));
}

bool is_by_viscard(const std::string& text) {
  return text.find("viscard ") != std::string::npos &&
         text.find("conventions: ") != std::string::npos;
}

}  // namespace

std::optional<CardFinding> form_difference(const std::string& text, const ReadCard& read) {
  if (!is_by_viscard(text)) return std::nullopt;
  // Where each number carries its unit, the reader converts them; the header states the system.
  const std::string stated = stated_unit_system(text);
  const bool are_converted = read.understood.numbers_carry_units && !stated.empty();
  const UnitSystem& units = are_converted ? unit_system(stated) : read.units;
  const CardNumbers numbers =
      are_converted ? numbers_from_material(read.material, read.understood, units) : read.numbers;
  const CardBody body{
      card_identifier(read.name), numbers, read.understood, units, read.material, {}};
  auto finding = first_difference(text, read.understood.write(body), read.understood);
  if (finding && !finding->is_mistake) {
    finding->text += "; the numbers are right, but will the solver take this line?";
  }
  return finding;
}

std::optional<CardFinding> form_difference(const std::string& text, const CardTarget& target,
                                           const Material& reference) {
  if (!is_by_viscard(text)) return std::nullopt;
  const std::string stated = stated_unit_system(text);
  const UnitSystem& units = unit_system(stated.empty() ? "SI" : stated);
  const CardBody body{reference.name, numbers_from_material(reference, target, units),
                      target,         units,
                      reference,      {}};
  return first_difference(text, target.write(body), target);
}

std::optional<CardFinding> form_difference(const std::string& text, const CardBody& right) {
  if (!is_by_viscard(text)) return std::nullopt;
  auto finding = first_difference(text, right.target.write(right), right.target);
  if (finding) finding->text += "; the numbers are right, but will the solver take this line?";
  return finding;
}

}  // namespace viscard
