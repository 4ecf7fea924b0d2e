#pragma once

#include "io/cards/card_numbers.h"

#include <string>
#include <vector>

namespace viscard {

class ResultVisitor;

struct CardLine;

// Relative; a number typed by hand may have few digits.
inline constexpr double kHandTyped = 2e-3;

// Text in a card that the solver interprets differently from what its author meant.
struct CardFinding {
  std::string name;  // short and stable: "missing-equilibrium-row"
  std::string text;  // the effect, and what to write instead
  bool is_mistake = true;
};
void show_keys(ResultVisitor& v, const CardFinding& finding);
// The note "not-read" of parts of a material that no reader used.
void add_unread_parts(const std::vector<std::string>& parts, std::vector<CardFinding>& findings);
// True if there is one: then nothing may be said of the whole card.
bool has_unread_parts(const std::vector<CardFinding>& findings);

struct ReadCard {
  CardTarget understood;  // the target's conventions, changed where the card states others
  UnitSystem units;
  bool units_were_stated = false;  // in the card's header or in its own unit block
  std::string name;
  CardNumbers numbers = {};
  Material material = {};  // SI; what the solver would simulate
  std::vector<CardFinding> findings = {};
  std::vector<CardValue> values = {};       // of a target with CardTarget::values
  std::vector<double> frequencies_Hz = {};  // of its table, or the ends of its band
  // A keyword whose absence makes the elastic modulus the long-term one; "" if it is there.
  std::string missing_keyword;
  std::string also_read = {};  // numbers that say nothing alone: the temperature of an only row

  void add(const char* finding, const std::string& text, bool is_mistake = true) {
    findings.push_back({finding, text, is_mistake});
  }
  // Parts of the material that no reader used, each with its line: the note "not-read".
  void add_unread(const std::vector<std::string>& parts);
  // Solvers take one of two materials of a file, which one depends on the solver.
  void add_second_material(const CardLine& line);
};

// Adds the note "not-read" of each word and number of the material that leaves all that is read the same when it is
// changed (io/cards/unread_tokens.h).
void note_unread_tokens(const std::string& text, const CardTarget& target, const std::string& units,
                        std::vector<CardFinding>& findings);
// The same of a law of rubber.
void note_unread_of_law(const std::string& text, const CardTarget& target, const std::string& units,
                        std::vector<CardFinding>& findings);

// The unit system in "units: mm-t-s (...)" of a header, or "".
std::string stated_unit_system(const std::string& text);

// Reads a card, written by viscard or by hand, as the target's solver would. `units` names the unit
// system; empty: that of the header, else SI. Throws std::runtime_error naming the line and what
// was expected there, std::invalid_argument for an unknown unit system or a csv table.
ReadCard read_card(const std::string& text, const CardTarget& target, const std::string& units);
// The same of a law of rubber, for a target that has them: the numbers, as they stand in the card. `understood` states
// whether they are those at once, shares or moduli of branches, and K or (kPoissonOnly) Poisson's ratio.
ReadCard read_law_numbers(const std::string& text, const CardTarget& target,
                          const std::string& units);

}  // namespace viscard
