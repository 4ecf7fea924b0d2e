#pragma once

#include "io/cards/unit_system.h"
#include "models/material/material.h"

#include <string>

namespace viscard {

// Runs a card in CalculiX (Debian's ccx) on one element and compares with the exact answer.

// Error of one test, relative to the exact answer, over the hold.
struct StepError {
  double at_step = 0.0;    // at the coarser of the two steps
  double worst_s = 0.0;    // time of that error
  double remaining = 0.0;  // after extrapolation of both steps to zero at first order

  // CalculiX integrates to first order, so the error of a right card is proportional to the step,
  // except for second-order terms that grow with the relaxed share. That of a wrong card remains.
  bool vanishes_with_step() const;
};

struct CalculixProof {
  StepError relaxation, creep;
  double end_s = 0.0;  // end of the tests
  int increments = 0;  // of each test at the coarser step

  bool holds() const { return relaxation.vanishes_with_step() && creep.vanishes_with_step(); }
};

// Runs both tests at two steps, steps_per_tau and twice as many in the shortest relaxation time, in
// temporary folders. `material` is what the card should be, under the target's bulk rule. Throws
// std::runtime_error if ccx is not installed, stops, or prints nothing.
CalculixProof prove_in_calculix(const std::string& card_text, const Material& material,
                                const UnitSystem& units, int steps_per_tau = 40);

}  // namespace viscard
