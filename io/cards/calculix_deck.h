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

// How far one test of the solver is from the exact answer, relative to it, over the hold.
struct StepError {
  double at_step = 0.0;    // at the coarser of the two steps
  double worst_s = 0.0;    // when
  double remaining = 0.0;  // after extrapolating both steps to none at first order

  // CalculiX integrates to first order, so a right card's error goes with the step, but for terms
  // of second order that grow with the relaxed share. A wrong card's error stays.
  bool vanishes_with_step() const;
};

// What Debian's ccx makes of a card.
struct CalculixProof {
  StepError relaxation, creep;
  double end_s = 0.0;  // how far it was followed
  int increments = 0;  // of each test at the coarser step

  bool holds() const { return relaxation.vanishes_with_step() && creep.vanishes_with_step(); }
};

// Runs both tests at two steps, steps_per_tau and twice as many in the shortest relaxation time, in
// temporary folders. `material` is what the card is meant to be, under the target's bulk rule.
// Throws std::runtime_error when ccx is not installed, stops, or prints nothing.
CalculixProof prove_in_calculix(const std::string& card_text, const Material& material,
                                const UnitSystem& units, int steps_per_tau = 40);

}  // namespace viscard
