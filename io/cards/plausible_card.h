#pragma once

#include "io/cards/read_card.h"
#include "models/quantities/plausible.h"

#include <optional>

namespace viscard {

// Stiffness and density as a card states them.
struct CardScale {
  double modulus_Pa = 0.0;  // Young's modulus at once, or of a law at rest; 0: none
  double rho_kg_m3 = 0.0;   // 0: none
  const UnitSystem* read_in =
      nullptr;  // the units the card was read in; null: each number has its own
};

// The mistake "implausible" if no solid has these numbers, with the system of units in which one would.
// text: the card, which may say that its numbers were accepted.
std::optional<CardFinding> implausible_finding(const std::string& text, const CardScale& scale,
                                               Plausible judged);

}  // namespace viscard
