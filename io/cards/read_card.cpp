#include "io/cards/read_card.h"

#include "io/basics/patterns.h"
#include "io/cards/card_lines.h"
#include "io/cards/header_name.h"
#include "io/cards/unread_tokens.h"
#include "models/maths/result_visitor.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <stdexcept>

namespace viscard {
namespace {

// The MFront writer pads its arrays with empty branches.
void drop_empty_branches(CardNumbers& numbers) {
  std::erase_if(numbers.branches,
                [](const CardBranch& b) { return b.shear == 0.0 && b.bulk == 0.0; });
}

bool has_negative_branch(ReadCard& card) {
  for (std::size_t i = 0; i < card.numbers.branches.size(); ++i) {
    const CardBranch& branch = card.numbers.branches[i];
    if (branch.shear >= 0.0 && branch.bulk >= 0.0) continue;
    card.add("negative-branch", "branch " + std::to_string(i + 1) +
                                    " is negative: it would gain energy, and solvers refuse it");
    return true;
  }
  return false;
}

// Whether the slow search for a number with that letter is worth it.
bool has_d_behind_digit(const std::string& line) {
  for (std::size_t at = line.find_first_of("dD", 1); at != std::string::npos;
       at = line.find_first_of("dD", at + 1)) {
    if (std::isdigit(static_cast<unsigned char>(line[at - 1])) != 0 || line[at - 1] == '.') {
      return true;
    }
  }
  return false;
}

// A reader in C, C++ or Java takes 1.88D+00 for 1.88, or stops.
void note_fortran_number(const std::string& text, ReadCard& card) {
  const CardTarget& target = card.understood;
  if (target.reads_fortran_numbers) return;
  for (const CardLine& line : card_lines(text, target.comment)) {
    if (!has_d_behind_digit(line.text)) continue;
    const auto found = first_match(
        line.text,
        R"((?:^|[^\w.])(\d+\.\d*[dD][-+]?\d+|\d*\.\d+[dD][-+]?\d+|\d+[dD][-+]\d+)(?![\w.]))");
    if (!found) continue;
    card.add("fortran-exponent",
             at_line(line, "'" + found->group[1] + "' has the exponent of Fortran, which " +
                               target.code + " does not read; write e for D"));
    return;
  }
}

// Everything that was read, as text.
std::string reading_of(const ReadCard& read) {
  const CardNumbers& n = read.numbers;
  std::string out =
      fmt::format("{} {} {} {} {} {} {} {} {} {}", read.name, read.units.name, n.young, n.poisson,
                  n.bulk, n.shear, n.equilibrium, n.density, read.missing_keyword, read.also_read);
  for (const CardBranch& branch : n.branches)
    out += fmt::format(" {} {} {}", branch.shear, branch.bulk, branch.time);
  if (!n.moduli.empty())
    out += fmt::format(" law {} {} {}", static_cast<int>(n.form), fmt::join(n.moduli, " "),
                       fmt::join(n.shapes, " "));
  for (const CardNumbers::FoamTerm& term : n.foam)
    out += fmt::format(" {} {} {}", term.mu, term.alpha, term.nu);
  if (n.damage) out += fmt::format(" damage {} {} {}", n.damage->r, n.damage->m, n.damage->beta);
  out += to_word(read.understood.at);
  if (n.shift)
    out += fmt::format(" {} {} {} {} {}", static_cast<int>(n.shift->law), n.shift->T_ref_C,
                       n.shift->C1, n.shift->C2_K, n.shift->activation_J_mol);
  for (const double frequency_Hz : read.frequencies_Hz) out += fmt::format(" {}", frequency_Hz);
  for (const CardValue& value : read.values) out += fmt::format(" {}", value.value);
  for (const CardFinding& finding : read.findings) out += " " + finding.text;
  return out;
}

// In the units that are named, else stated, else SI.
ReadCard nothing_read(const std::string& text, const CardTarget& target, const std::string& units) {
  const std::string stated = stated_unit_system(text);
  return {.understood = target,
          .units = unit_system(!units.empty()    ? units
                               : !stated.empty() ? stated
                                                 : "SI"),
          .units_were_stated = !stated.empty()};
}

}  // namespace

void show_keys(ResultVisitor& v, const CardFinding& finding) {
  v("name", finding.name, "its name");
  v("mistake", finding.is_mistake, "false: a note");
  v("text", finding.text, "in words");
}

void add_unread_parts(const std::vector<std::string>& parts, std::vector<CardFinding>& findings) {
  for (const std::string& part : parts)
    findings.push_back({"not-read", part + " is not read: the solver may use it", false});
}

bool has_unread_parts(const std::vector<CardFinding>& findings) {
  static const std::array<const char*, 8> kUnread{
      "column-not-read",     "not-read",  "line-not-read", "more-elastic-rows",
      "parameter-not-known", "bulk-rows", "creep-ratio",   "more-temperatures"};
  return std::any_of(findings.begin(), findings.end(), [](const CardFinding& finding) {
    return std::find(kUnread.begin(), kUnread.end(), finding.name) != kUnread.end();
  });
}

void note_unread_tokens(const std::string& text, const CardTarget& target, const std::string& units,
                        std::vector<CardFinding>& findings) {
  add_unread_parts(unread_tokens(text, target.name,
                                 [&](const std::string& changed) {
                                   return reading_of(read_card(changed, target, units));
                                 }),
                   findings);
}

void note_unread_of_law(const std::string& text, const CardTarget& target, const std::string& units,
                        std::vector<CardFinding>& findings) {
  add_unread_parts(unread_tokens(text, target.name,
                                 [&](const std::string& changed) {
                                   return reading_of(read_law_numbers(changed, target, units));
                                 }),
                   findings);
}

void ReadCard::add_unread(const std::vector<std::string>& parts) {
  add_unread_parts(parts, findings);
}

void ReadCard::add_second_material(const CardLine& line) {
  add("several-materials",
      at_line(line, "a second material begins; choose one by --material-name"));
}

std::string stated_unit_system(const std::string& text) {
  constexpr std::string_view kUnits = "units: ";
  const std::size_t at = text.find(kUnits);
  if (at == std::string::npos) return "";
  // Headers by hand may have other words before it.
  const std::size_t stated = behind_mark(text, kUnits);
  const std::size_t begin = stated == std::string::npos ? at + kUnits.size() : stated;
  const std::size_t end = text.find_first_of(" \n\"", begin);
  const std::string name = text.substr(begin, end - begin);
  return find_unit_system(name) != nullptr ? name : "";
}

ReadCard read_law_numbers(const std::string& text, const CardTarget& target,
                          const std::string& units) {
  ReadCard card = nothing_read(text, target, units);
  card.understood.elastic = ElasticForm::kBulkShear;
  card.understood.at = ModulusAt::kInstantaneous;
  card.understood.branch = BranchNumber::kRelative;
  target.laws->read(text, card);
  note_fortran_number(text, card);
  return card;
}

ReadCard read_card(const std::string& text, const CardTarget& target, const std::string& units) {
  ReadCard card = nothing_read(text, target, units);
  target.read(text, card);
  note_fortran_number(text, card);
  if (target.values != nullptr) return card;
  drop_empty_branches(card.numbers);
  if (!has_negative_branch(card)) {
    try {
      card.material = material_from_numbers(card.numbers, card.understood, card.units);
    } catch (const std::invalid_argument& error) {
      card.add("no-solid", error.what());
    }
  }
  card.material.name = card.name;
  return card;
}

}  // namespace viscard
