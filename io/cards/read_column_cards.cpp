// Readers of fixed-column files: LS-DYNA 076 and 006, OpenRadioss LAW40.
#include "io/cards/card_lines.h"

#include <stdexcept>

namespace viscard {
namespace {

// The lines below the first keyword that starts with one of the names, up to the next keyword.
struct KeywordCards {
  std::vector<CardLine> lines;
  std::size_t width = 10;
  std::string title;
};

KeywordCards lsdyna_cards(const std::string& text, const std::string& long_name,
                          const std::string& short_name) {
  KeywordCards cards;
  bool inside = false, wants_title = false, is_long_deck = false;
  for (const CardLine& line : card_lines(text, "$")) {
    const std::string word = upper(trimmed(line.text));
    if (!word.empty() && word[0] == '*') {
      if (inside) break;
      if (word.rfind("*KEYWORD", 0) == 0) is_long_deck = word.find("LONG=Y") != std::string::npos;
      inside = word.rfind(long_name, 0) == 0 || word.rfind(short_name, 0) == 0;
      wants_title = inside && word.find("_TITLE") != std::string::npos;
      if (is_long_deck || word.back() == '+') cards.width = 20;
    } else if (inside && wants_title) {
      cards.title = trimmed(line.text);
      wants_title = false;
    } else if (inside) {
      cards.lines.push_back(line);
    }
  }
  if (cards.lines.empty()) {
    throw std::runtime_error("the card has no " + long_name + " (or " + short_name + ") with data");
  }
  return cards;
}

bool is_blank(const CardLine& line) {
  return trimmed(line.text).empty();
}

// A row of moduli where card 2 belongs has a decimal point in its first field; LCID is an integer.
bool is_row_of_moduli(const CardLine& line, std::size_t width) {
  const std::vector<std::string> row = columns(line.text, width);
  return !row.empty() && row[0].find_first_of(".eE") != std::string::npos;
}

}  // namespace

void read_lsdyna(const std::string& text, ReadCard& card) {
  const KeywordCards cards = lsdyna_cards(text, "*MAT_GENERAL_VISCOELASTIC", "*MAT_076");
  card.name = cards.title;
  const CardLine& first = cards.lines.front();
  const auto row = columns(first.text, cards.width);
  card.numbers.density = cell_number_or_zero(row, 1, first, "RO");
  card.numbers.bulk = cell_number(row, 2, first, "BULK");
  std::size_t next = 1;
  if (cards.lines.size() > 1 && is_row_of_moduli(cards.lines[1], cards.width)) {
    card.findings.push_back(
        {"missing-blank-card",
         "line " + std::to_string(cards.lines[1].number) +
             ": card 2 (LCID ...) is missing, an empty line; LS-DYNA takes this "
             "row for it and all rows shift",
         true});
  } else if (cards.lines.size() > 1) {
    const auto fit = columns(cards.lines[1].text, cards.width);
    if (cell_number_or_zero(fit, 0, cards.lines[1], "LCID") != 0.0) {
      card.findings.push_back({"fit-by-solver",
                               "line " + std::to_string(cards.lines[1].number) +
                                   ": LCID is set, so LS-DYNA fits a curve and ignores the rows",
                               true});
    }
    next = 2;
  }
  bool has_equilibrium = false;
  for (; next < cards.lines.size(); ++next) {
    const CardLine& line = cards.lines[next];
    if (is_blank(line)) continue;
    const auto fields = columns(line.text, cards.width);
    const double shear = cell_number_or_zero(fields, 0, line, "GI");
    const double beta = cell_number_or_zero(fields, 1, line, "BETAI");
    if (cell_number_or_zero(fields, 2, line, "KI") != 0.0) {
      card.findings.push_back({"bulk-rows",
                               "line " + std::to_string(line.number) +
                                   ": KI is set; whether BULK adds to it is not documented, so it "
                                   "is not read",
                               false});
    }
    if (beta == 0.0) {
      has_equilibrium = true;
      card.numbers.equilibrium += shear;
    } else {
      card.numbers.branches.push_back({shear, 0.0, beta});
    }
  }
  if (!has_equilibrium) {
    card.findings.push_back({"missing-equilibrium-row",
                             "no row has BETA = 0: the material flows like a liquid; add the row "
                             "G_inf, 0",
                             true});
  }
}

void read_lsdyna006(const std::string& text, ReadCard& card) {
  const KeywordCards cards = lsdyna_cards(text, "*MAT_VISCOELASTIC", "*MAT_006");
  card.name = cards.title;
  const CardLine& line = cards.lines.front();
  const auto row = columns(line.text, cards.width);
  card.numbers.density = cell_number_or_zero(row, 1, line, "RO");
  card.numbers.bulk = cell_number(row, 2, line, "BULK");
  const double instantaneous = cell_number(row, 3, line, "G0");
  card.numbers.equilibrium = cell_number(row, 4, line, "GI");
  const double beta = cell_number_or_zero(row, 5, line, "BETA");
  if (!(instantaneous >= card.numbers.equilibrium)) {
    card.findings.push_back({"g0-below-gi",
                             "line " + std::to_string(line.number) +
                                 ": G0 (instantaneous) is below GI (long-term): swapped?",
                             true});
  }
  if (beta != 0.0) {
    card.numbers.branches.push_back({instantaneous - card.numbers.equilibrium, 0.0, beta});
  }
}

namespace {

// The unit block of Radioss: the first that fits one of our systems.
void read_radioss_units(const std::vector<CardLine>& lines, std::size_t at, ReadCard& card) {
  if (at + 2 >= lines.size()) return;
  const auto row = columns(lines[at + 2].text, 20);
  if (row.size() < 3) return;
  for (const UnitSystem& system : unit_systems()) {
    const bool is_mass = row[0] == system.mass || (row[0] == "t" && system.name[0] == 'm' &&
                                                   std::string(system.mass) == "Mg");
    if (is_mass && row[1] == system.length && row[2] == system.time) {
      card.units = system;
      card.units_were_stated = true;
      return;
    }
  }
  throw std::runtime_error("line " + std::to_string(lines[at + 2].number) + ": the units " +
                           row[0] + ", " + row[1] + ", " + row[2] +
                           " are none of the systems known here");
}

}  // namespace

void read_openradioss(const std::string& text, ReadCard& card) {
  const std::vector<CardLine> lines = card_lines(text, "#");
  std::size_t at = lines.size();
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const std::string word = upper(trimmed(lines[i].text));
    if (word.rfind("/UNIT/", 0) == 0) read_radioss_units(lines, i, card);
    if (word.rfind("/MAT/LAW40", 0) == 0 || word.rfind("/MAT/KELVINMAX", 0) == 0) at = i;
  }
  if (at + 5 >= lines.size()) {
    throw std::runtime_error(
        "the card has no complete /MAT/LAW40 (title and four lines of numbers)");
  }
  card.name = trimmed(lines[at + 1].text);
  const auto row = [&](std::size_t offset) { return columns(lines[at + offset].text, 20); };
  card.numbers.density = cell_number_or_zero(row(2), 0, lines[at + 2], "RHO_I");
  card.numbers.bulk = cell_number(row(3), 0, lines[at + 3], "K");
  card.numbers.equilibrium = cell_number(row(3), 1, lines[at + 3], "G_inf");
  for (std::size_t i = 0; i < 5; ++i) {
    const double shear = cell_number_or_zero(row(4), i, lines[at + 4], "G");
    if (shear == 0.0) continue;
    card.numbers.branches.push_back(
        {shear, 0.0, cell_number_or_zero(row(5), i, lines[at + 5], "BETA")});
  }
}

}  // namespace viscard
