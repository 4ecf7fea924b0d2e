#pragma once

#include "models/hyperelastic/hyperelastic_law.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace viscard {

// One test of a rubber: force over area at rest against stretch, in the order of the readings.
// Compression is a uniaxial test with stretches below 1 and negative stresses.
struct LargeStrainTest {
  std::string name;  // for messages: "planar"
  Deformation deformation = Deformation::kUniaxial;
  std::vector<double> stretch, nominal_stress_Pa;
};

// kEqual: every stress counts alike, so that the largest stresses decide. kRelative: every stress
// counts by its own size, but not less than a hundredth of the largest one of its test.
enum class StressWeight { kEqual, kRelative };

// Young's modulus at rest that the law must have, with its standard error; 0: exactly.
struct KnownModulus {
  double value_Pa = 0.0, se_Pa = 0.0;
};

// Which laws are fitted, and how stresses count.
struct LargeStrainOptions {
  std::vector<HyperelasticForm> forms = hyperelastic_forms();
  StressWeight weight = StressWeight::kEqual;
  std::optional<KnownModulus> modulus;
};

}  // namespace viscard
