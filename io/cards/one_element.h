#pragma once

#include "models/material/material.h"

#include <string>
#include <vector>

namespace viscard {

// The test that proves a card: a unit cube in simple tension, its sides free. In relaxation the
// strain rises linearly during the ramp and is held, in creep the stress. Both have closed answers.
enum class ElementTestKind { kRelaxation, kCreep };

struct TimeBlock {
  double end_s = 0.0;
  int increments = 0;  // of equal length
};

struct ElementTest {
  ElementTestKind kind = ElementTestKind::kRelaxation;
  double amplitude = 1e-6;  // strain held; in creep stress held over E0
  double ramp_s = 0.0;
  std::vector<TimeBlock> blocks;  // the first is the ramp

  double end_s() const { return blocks.back().end_s; }
};

struct ElementTestOptions {
  ElementTestKind kind = ElementTestKind::kRelaxation;
  double amplitude = 1e-6;
  int steps_per_tau = 40;          // in the shortest relaxation time
  double longest_step_tau = 1e30;  // limit of an increment, in shortest relaxation times
  int most_increments = 20000;     // the hold ends early if it would need more
};

// Ramp of half the shortest relaxation time, hold to ten times the longest; increments grow with
// time. A material without terms is held for 1 s.
ElementTest element_test(const Material& material, const ElementTestOptions& options);

// Stress over amplitude and E0 (relaxation) or strain over amplitude (creep) at a time: exact, from
// E(t) or the creep compliance J(t), integrated over the ramp (models/README.md, eq. 1, 3, 5).
double exact_response(const Material& material, const ElementTest& test, double time_s);

// The header, then rows of time and response, four per block. time_factor: s to the card's unit.
std::string expected_curve_csv(const Material& material, const ElementTest& test,
                               double time_factor, const std::string& header);

}  // namespace viscard
