#include "io/cards/card_form.h"

#include "io/cards/card.h"
#include "io/cards/card_header.h"
#include "io/cards/card_lines.h"
#include "io/cards/list_differences.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <iterator>
#include <sstream>
#include <stdexcept>
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

struct HeaderLine {
  CardLine line;
  std::string key, text;  // "units", "mm-t-s (...)"
};

// The lines in comments; of a JSON card those of its list "header".
std::vector<HeaderLine> header_lines(const std::string& text, const CardTarget& target) {
  const bool is_json = target.comment.empty();
  const std::size_t from = is_json ? std::min(text.find("\"header\""), text.size()) : 0;
  const auto lines_before =
      std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(from), '\n');
  std::vector<HeaderLine> out;
  for (CardLine& line : card_lines(text.substr(from), "\n")) {
    line.number += static_cast<int>(lines_before);
    std::string words(trimmed(line.text));
    if (!is_json && words.rfind(target.comment, 0) != 0) continue;
    words.erase(0, is_json ? 1 : target.comment.size());
    const std::string end = is_json ? "\"" : target.comment == "<!--" ? "-->" : "";
    if (!end.empty()) words = words.substr(0, words.rfind(end));
    const std::size_t colon = words.find(": "), equals = words.find(" = ");
    const std::size_t at = std::min(colon, equals);
    const std::size_t begin = at == std::string::npos ? words.size() : words.find(' ', at + 1);
    std::string key(trimmed(words.substr(0, at)));
    // Commits of one version write the same headers.
    if (key.rfind("viscard ", 0) == 0) key.erase(std::min(key.find('+'), key.size()));
    out.push_back({line, key, std::string(trimmed(words.substr(begin)))});
  }
  return out;
}

// Equal but for numbers that differ by no more than the tolerance.
bool has_same_words(const std::string& one, const std::string& other, double tolerance) {
  std::istringstream a(one), b(other);
  std::string of_a, of_b;
  while (true) {
    const bool has_a = static_cast<bool>(a >> of_a), has_b = static_cast<bool>(b >> of_b);
    if (!has_a || !has_b) return has_a == has_b;
    if (of_a == of_b) continue;
    const auto x = number_from_text(of_a), y = number_from_text(of_b);
    if (!x || !y || relative_mismatch(*x, *y) > tolerance) return false;
  }
}

// Statement of a header about the target, for any name of the material: "... for Abaqus". The
// origin of nu is known only with the material.
std::string comparable_text(const HeaderLine& line, bool has_reference) {
  const bool is_title = line.key.rfind("viscard ", 0) == 0;
  const std::size_t at = line.text.rfind(" for ");
  if (is_title && at != std::string::npos) return line.text.substr(at);
  return line.key == "K0" && !has_reference ? line.text.substr(0, line.text.find(" (")) : line.text;
}

// Without the material, only values that the numbers of the card determine are checked.
bool follows_from_card(const std::string& key) {
  return key.rfind("viscard ", 0) == 0 || key == "CANNOT REPRESENT" || key == "units" ||
         key == "conventions" || key == "E0 (instantaneous)" || key == "K0" || key == "rho" ||
         key.rfind("SET THE TEMPERATURE", 0) == 0;
}

std::string title_key() {
  return std::string("viscard ") + VISCARD_VERSION;
}

// True if a line of the header is as viscard writes it; nothing if the header has no such line.
struct HeaderMatch {
  const HeaderLine* line = nullptr;
  bool is_same = false;
};

// A key that viscard writes once must have the same value wherever it stands.
HeaderMatch match_of(const HeaderLine& wanted, const std::vector<HeaderLine>& found, bool is_only,
                     bool has_reference) {
  // Columns may have rounded the numbers that were read from the card.
  const double tolerance = has_reference ? 1e-6 : 2e-4;
  HeaderMatch match;
  int lines = 0, same = 0;
  for (const HeaderLine& one : found) {
    if (one.key != wanted.key) continue;
    const bool is_same = has_same_words(comparable_text(one, has_reference),
                                        comparable_text(wanted, has_reference), tolerance);
    if (match.line == nullptr || !is_same) match.line = &one;
    ++lines;
    same += is_same ? 1 : 0;
  }
  match.is_same = same > 0 && (!is_only || same == lines);
  return match;
}

// Refitted or omitted terms cannot be seen in the material that is compared.
bool are_terms_changed(const std::vector<HeaderLine>& header) {
  return std::any_of(header.begin(), header.end(), [](const HeaderLine& line) {
    const bool is_approximated = line.text.rfind("approximated", 0) == 0;
    return line.key == "terms" && (is_approximated || line.text.rfind("dropped", 0) == 0);
  });
}

// One finding of the first contradiction, one of the first line that is missing.
std::vector<CardFinding> compare_headers(const std::vector<HeaderLine>& found,
                                         const std::vector<HeaderLine>& wanted,
                                         bool has_reference) {
  const bool skips_terms = are_terms_changed(found);
  std::optional<CardFinding> differs, is_missing;
  for (const HeaderLine& line : wanted) {
    if (line.key.rfind("card sha256", 0) == 0) continue;  // of the text: check_card() compares it
    if (!has_reference && !follows_from_card(line.key)) continue;
    if (skips_terms && (line.key == "terms" || line.key == "total")) continue;
    const bool is_only = std::count_if(wanted.begin(), wanted.end(), [&](const HeaderLine& other) {
                           return other.key == line.key;
                         }) == 1;
    const HeaderMatch match = match_of(line, found, is_only, has_reference);
    if (match.is_same) continue;
    const std::string right = "' where viscard writes '" + line.text + "'";
    if (match.line != nullptr && !differs) {
      differs = CardFinding{
          "header-differs",
          at_line(match.line->line, "'" + line.key + "' reads '" + match.line->text + right), true};
    } else if (match.line == nullptr && !is_missing &&
               line.key != "rho") {  // older headers lack it
      is_missing =
          CardFinding{"header-incomplete", "the header has no '" + line.key + right, false};
    }
  }
  std::vector<CardFinding> findings;
  if (differs) findings.push_back(*differs);
  if (is_missing) findings.push_back(*is_missing);
  return findings;
}

bool is_by_viscard(const std::string& text) {
  return text.find("viscard ") != std::string::npos &&
         text.find("conventions: ") != std::string::npos;
}

}  // namespace

std::optional<CardFinding> form_difference(const std::string& text, const ReadCard& read) {
  // Modules for Python are by viscard even without their header.
  if (!is_by_viscard(text) && !read.understood.is_indented) return std::nullopt;
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
  // A whole file with its own first line is by viscard even without its header.
  if (!is_by_viscard(text) && right.target.first_line.empty()) return std::nullopt;
  auto finding = first_difference(text, right.target.write(right), right.target);
  if (finding) finding->text += "; the numbers are right, but will the solver take this line?";
  return finding;
}

std::vector<CardFinding> header_differences(const std::string& text, const ReadCard& read,
                                            const CardTarget& target, const Material* reference) {
  const std::vector<HeaderLine> found = header_lines(text, target);
  const bool is_of_this_version = std::any_of(
      found.begin(), found.end(), [](const HeaderLine& line) { return line.key == title_key(); });
  if (!is_by_viscard(text) || !is_of_this_version) return {};
  const std::string stated = stated_unit_system(text);
  CardOptions options{.units = stated.empty() ? read.units.name : stated,
                      .is_reproducible = true,
                      .may_approximate = true,
                      .accepts_flags = true};
  if (target.band_note != nullptr && !read.frequencies_Hz.empty()) {
    options.band = FrequencyBand{read.frequencies_Hz.front(), read.frequencies_Hz.back()};
  }
  try {
    const bool is_of_target = read.understood.name == target.name;
    const Card right = write_card(reference == nullptr ? read.material : *reference,
                                  is_of_target ? target : read.understood, options);
    return compare_headers(found, header_lines(right.text, target), reference != nullptr);
  } catch (const std::invalid_argument&) {
    return {};  // the target does not take this material at all
  }
}

}  // namespace viscard
