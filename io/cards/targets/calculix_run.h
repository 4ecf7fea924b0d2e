#pragma once

#include "io/cards/card.h"
#include "io/cards/one_element.h"
#include "io/cards/unit_system.h"

#include <vector>

namespace viscard {

// One run of Debian's ccx on the one-element deck of a card, in a temporary folder.

struct SolverSample {
  double time_s = 0.0;
  double value = 0.0;  // response over the amplitude, as exact_response returns it
};

struct SolverRun {
  std::vector<SolverSample> samples;  // after every increment, until it diverged
  bool diverged = false;              // "solution seems to diverge": the increment, not the syntax
};

// Throws std::runtime_error if ccx is not installed, stops for another reason, or prints nothing.
SolverRun run_in_calculix(const Card& card, const UnitSystem& units, const ElementTest& test);

}  // namespace viscard
