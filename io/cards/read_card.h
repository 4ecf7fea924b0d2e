#pragma once

#include "io/cards/card_numbers.h"

#include <string>
#include <vector>

namespace viscard {

// Something a reader saw that the solver would take differently from what was meant.
struct CardFinding {
  std::string name;  // short and stable: "missing-equilibrium-row"
  std::string text;  // what it does and what to write instead
  bool is_mistake = true;
};

struct ReadCard {
  CardTarget understood;  // the target's conventions, changed where the card says otherwise
  UnitSystem units;
  bool units_were_stated = false;  // in the card's header or in its own unit block
  std::string name;
  CardNumbers numbers;
  Material material;  // SI; what the solver would simulate
  std::vector<CardFinding> findings;
};

// Reads a card of one dialect, ours or hand-written. `units` names the unit system; empty: the one
// the header states, else SI. CSV tables hold no material: see check_table. Throws
// std::runtime_error naming the line and what was expected there, std::invalid_argument for an
// unknown target or unit system.
ReadCard read_card(const std::string& text, const std::string& target, const std::string& units);

}  // namespace viscard
