#pragma once

#include "io/cards/unit_system.h"
#include "models/material/material.h"

#include <optional>
#include <string>
#include <vector>

namespace viscard {

// Runs a card in CalculiX (Debian's ccx) on one element and compares with the exact answer. The
// load rises in every block of a doubled time (one_element.h), so every term is loaded in its own
// decade, with increments that start again from the size of the block.

// Error of one test, relative to the exact answer, after the first ramp.
struct StepError {
  double at_step = 0.0;    // at the coarsest of the three steps
  double worst_s = 0.0;    // time of that error
  double remaining = 0.0;  // after extrapolation of the three steps to zero
  // The smallest error that the test can distinguish from that of the step: the last correction of
  // the extrapolation, or the digits that ccx prints.
  double resolved = 0.0;

  // CalculiX integrates to first order, so the error of a right card vanishes with the step. That
  // of a wrong card remains.
  bool vanishes_with_step() const { return remaining <= resolved; }
};

// Whether the proof would have noticed a wrong term.
struct TermProof {
  double g = 0.0, tau_s = 0.0;
  double change = 0.0;        // largest relative change of an answer if tau were a tenth longer
  bool is_exercised = false;  // that change is at least twice what the test resolves
};

struct SolverDivergence {
  std::string test;  // "relaxation" or "creep"
  double reached_s = 0.0;
  // The same test of the card that viscard writes for this material runs to the end, so the numbers
  // of the given card are to blame. Otherwise it is a limit of ccx, and nothing is known.
  bool is_card_blamed = false;
};

struct CalculixProof {
  StepError relaxation, creep;
  std::vector<TermProof> terms;
  std::optional<SolverDivergence> divergence;  // if set, the errors above are not filled
  double end_s = 0.0;                          // end of the tests
  int increments = 0;                          // of each test at the coarsest step

  bool agrees() const {
    return !divergence && relaxation.vanishes_with_step() && creep.vanishes_with_step();
  }
  bool exercises_all_terms() const;
  bool holds() const { return agrees() && exercises_all_terms(); }
};

// Runs both tests at three steps: steps_per_tau in the shortest relaxation time, twice and four
// times as many, in temporary folders. `material` is what the card should be, under the target's
// bulk rule. Throws std::runtime_error if ccx is not installed, stops, or prints nothing.
CalculixProof prove_in_calculix(const std::string& card_text, const Material& material,
                                const UnitSystem& units, int steps_per_tau = 40);

}  // namespace viscard
