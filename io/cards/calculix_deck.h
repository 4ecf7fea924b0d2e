#pragma once

#include "io/cards/one_element.h"
#include "io/cards/unit_system.h"

#include <string>
#include <vector>

namespace viscard {

// Names after *MATERIAL, NAME= in the order of the card.
std::vector<std::string> material_names(const std::string& card_text);

// A unit cube of one C3D8 element per material of the card on the same eight nodes, the card
// itself, and one *VISCO step of fixed increments per block. Prints the reaction of the base
// (relaxation) or the displacement of the top (creep) after every increment. E0_Pa scales the load
// of a creep test.
std::string calculix_deck(const std::string& card_text, const ElementTest& test, double E0_Pa,
                          const UnitSystem& units);

// What Debian's ccx makes of it.
struct CalculixProof {
  double relaxation_error = 0.0;  // largest relative difference in the hold, and when
  double creep_error = 0.0;
  double relaxation_worst_s = 0.0, creep_worst_s = 0.0;
  double end_s = 0.0;  // how far it was followed
  int increments = 0;  // of each test
};

// Runs both tests in a temporary folder. `material` is what the card is meant to be, under the
// target's bulk rule. Throws std::runtime_error when ccx is not installed, stops, or prints
// nothing.
CalculixProof prove_in_calculix(const std::string& card_text, const Material& material,
                                const UnitSystem& units, int steps_per_tau = 40);

}  // namespace viscard
