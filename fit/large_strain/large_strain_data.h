#pragma once

#include "models/hyperelastic/finite_viscoelasticity.h"
#include "models/hyperelastic/foam_law.h"
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
  std::vector<double> time_s = {};  // of the readings; empty: not known
  Course before = {};               // of the stretch, before the first reading
  // Of a foam: the kind of test, in which `stretch` is the measured quantity, and the stretch of the side of
  // each reading; empty: not measured.
  FoamTest foam_test = FoamTest::kUniaxial;
  std::vector<double> lateral_stretch = {};
};

// True if the readings have times, so that a relaxation can be fitted.
inline bool has_times(const LargeStrainTest& test) {
  return !test.time_s.empty();
}
// The course of the stretch with the readings at its end.
Course history_of(const LargeStrainTest& test);

// kEqual: every stress counts alike, so that the largest stresses decide. kRelative: every stress
// counts by its own size, but not less than a hundredth of the largest one of its test.
enum class StressWeight { kEqual, kRelative };

// Young's modulus at rest that the law must have, with its standard error; 0: exactly. Of the
// instantaneous law, or of the law after all relaxation.
struct KnownModulus {
  double value_Pa = 0.0, se_Pa = 0.0;
  bool is_long_term = false;
};

// Which laws are fitted, and how stresses count.
struct LargeStrainOptions {
  std::vector<HyperelasticForm> forms = hyperelastic_forms();
  StressWeight weight = StressWeight::kEqual;
  std::optional<KnownModulus> modulus;
  // Terms of relaxation beside the law: this number, or up to max_terms by BIC. Without both: up to 6
  // if the tests have times and show more than one rate, otherwise none.
  std::optional<int> n_terms, max_terms;
  // Damage by the first loading beside every law (models/hyperelastic/mullins_damage.h), instead of terms.
  // The tests are then whole records in the order of time, each of a specimen never loaded before.
  bool with_damage = false;
  // Foams of these numbers of terms (models/hyperelastic/foam_law.h) instead of laws of rubber, with the nu of
  // all terms if it is known.
  std::vector<Eigen::Index> foam_terms = {};
  std::optional<double> poisson_ratio = {};
};

}  // namespace viscard
