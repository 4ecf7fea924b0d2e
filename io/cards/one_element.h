#pragma once

#include "models/material/material.h"

#include <string>
#include <vector>

namespace viscard {

// The test that proves a card: a unit cube in simple tension, its sides free. In relaxation the
// strain rises linearly during the ramp and is held, in creep the stress. Confined, the strain of
// relaxation or the stress of creep acts while no side may move: the modulus K + 4 G/3 shows the bulk
// modulus, which free sides of a nearly incompressible body hardly do. An implicit solver needs the
// stress, because the strain leaves it no unknown. A rising test adds the
// same load again in every block, and each block doubles the time: so all decades are loaded, and
// no branch ever relaxes to zero. All have closed answers.
enum class ElementTestKind { kRelaxation, kCreep, kConfined, kConfinedCreep };

// A part of the test with increments of one length.
struct TimeBlock {
  double end_s = 0.0;
  int increments = 0;  // of equal length
  double load = 1.0;   // at the end of the block, in amplitudes; linear in time within it
};

// Loads of the test over time.
struct ElementTest {
  ElementTestKind kind = ElementTestKind::kRelaxation;
  double amplitude = 1e-6;  // strain after the ramp; in creep stress after it over E0
  double ramp_s = 0.0;
  std::vector<TimeBlock> blocks;  // the first is the ramp

  double end_s() const { return blocks.back().end_s; }
  bool is_creep() const {
    return kind == ElementTestKind::kCreep || kind == ElementTestKind::kConfinedCreep;
  }
  bool is_confined() const {
    return kind == ElementTestKind::kConfined || kind == ElementTestKind::kConfinedCreep;
  }
};

// From which the test of a material is made.
struct ElementTestOptions {
  ElementTestKind kind = ElementTestKind::kRelaxation;
  double amplitude = 1e-6;   // as in ElementTest
  int steps_per_tau = 40;    // in the shortest relaxation time
  double ramp_in_tau = 0.5;  // length of the ramp in the shortest relaxation time
  bool rises = false;        // every block adds the load of the ramp instead of holding it
  // All increments are of one length, and the ramp is longer if the test would need more of them
  // than this; 0: increments grow with time.
  int most_equal_increments = 0;
  // The ramp is longer if the test would last more of its lengths than this; 0: any number. Terms
  // that are much shorter than the ramp are then not exercised.
  double most_ramps = 0.0;
};

// Ramp of a part of the shortest relaxation time, then hold or rise to ten times the longest; increments
// grow with time. A material without terms is held for 1 s.
ElementTest element_test(const Material& material, const ElementTestOptions& options);

// Stress over amplitude and E0 (relaxation, confined) or strain over amplitude (creep) at a time: exact, from
// E(t) or the creep compliance J(t), integrated over the blocks (models/README.md, eq. 1, 3, 5).
double exact_response(const Material& material, const ElementTest& test, double time_s);

// The header, then rows of time and response, four per block. time_factor: s to the card's unit.
std::string expected_curve_csv(const Material& material, const ElementTest& test,
                               double time_factor, const std::string& header);

}  // namespace viscard
