// Laws of rubber with terms of relaxation in solvers: the law without its terms in CalculiX, and SfePy with the
// memory of the card's module.
#include "tests/io/cards/rubber_cube.h"
#include "tests/io/cards/rubber_rules.h"
#include "tests/io/cards/sfepy_cube.h"

#include <catch2/catch.hpp>

using namespace viscard;
using namespace viscard::test;

namespace {

std::string solid_card(const Rubber& solid, const char* target, double bulk_Pa,
                       const std::string& elastic_only = "") {
  return rubber_card(
      solid.law, solid.terms,
      {.target = target, .units = "mm-t-s", .bulk_Pa = bulk_Pa, .elastic_only = elastic_only});
}

// Nominal stresses of the module, extrapolated to an incompressible body, give the second Piola-Kirchhoff stress,
// which the module's Memory relaxes. Prints a row for each step: stress of SfePy, the same relaxed, and
// the module's own elastic_stress relaxed.
constexpr const char* kRelaxation = R"python(import numpy as np
import cube
import rubber

ramp = np.linspace(1.0, 1.8, 41)[1:]


def nominal(memory, s):
    S = memory.stress()[0]
    return s * S[2, 2] - S[0, 0] / s**2


elastic = 2.0 * cube.stresses("uniaxial", ramp, 2.0) - cube.stresses("uniaxial", ramp, 1.0)
by_sfepy, by_module = rubber.Memory(1), rubber.Memory(1)
steps = [(0.5 / len(ramp), s, P) for s, P in zip(ramp, elastic)]
steps += [(dt, ramp[-1], elastic[-1]) for dt in (0.5, 5.0)]
for dt, s, P in steps:
    d = P * s  # axial Kirchhoff stress of a body with free sides
    by_sfepy.advance(dt, np.diag([-d * s / 3.0, -d * s / 3.0, 2.0 * d / (3.0 * s**2)])[None])
    by_module.advance(dt, rubber.elastic_stress(np.diag([s**-0.5, s**-0.5, s])[None]))
    print(repr(float(P)), repr(float(nominal(by_sfepy, s))), repr(float(nominal(by_module, s))))
)python";

}  // namespace

TEST_CASE("rubber cards: CalculiX gives the stress at once and after all relaxation",
          "[io][golden]") {
  const double stretch = 1.8;
  for (const Rubber& solid : rubbers()) {
    const double bulk_Pa = 4e3 * youngs_modulus_Pa(solid.law) / 3.0;
    const Course jump{{0.0, 1.0}, {0.0, stretch}, {1e6, stretch}};
    const auto exact_Pa = nominal_stress_Pa(solid.law, solid.terms, Deformation::kUniaxial, jump);
    for (const bool is_at_once : {true, false}) {
      CAPTURE(name_of(solid.law.form), is_at_once);
      const char* when = is_at_once ? "instantaneous" : "long-term";
      const auto force_N = [&](double factor) {
        return run_in_calculix(cube_deck(solid_card(solid, "calculix", factor * bulk_Pa, when),
                                         Deformation::kUniaxial, stretch));
      };
      // Extrapolated to an incompressible body.
      CHECK(2.0 * force_N(2.0) - force_N(1.0) ==
            Approx(1e-6 * exact_Pa[is_at_once ? 1 : 2]).epsilon(2e-6));
    }
  }
}

TEST_CASE("rubber cards: SfePy with the memory of its module gives the relaxing stress",
          "[io][slow]") {
  if (!has_sfepy()) return;
  Course history{{0.0, 1.0}};
  constexpr int kSteps = 40;
  for (int i = 1; i <= kSteps; ++i) history.push_back({0.5 * i / kSteps, 1.0 + 0.8 * i / kSteps});
  for (const double time_s : {1.0, 6.0}) history.push_back({time_s, 1.8});
  for (const Rubber& solid : rubbers()) {
    CAPTURE(name_of(solid.law.form));
    const auto rows = numbers_from_sfepy(
        solid_card(solid, "sfepy", 4e3 * youngs_modulus_Pa(solid.law) / 3.0), kRelaxation);
    REQUIRE(rows.size() == 3 * (history.size() - 1));
    const auto exact_Pa =
        nominal_stress_Pa(solid.law, solid.terms, Deformation::kUniaxial, history);
    for (const std::size_t step :
         {std::size_t{5}, std::size_t{40}, std::size_t{41}, std::size_t{42}}) {
      CAPTURE(step);
      const double at_once_MPa =
          1e-6 * nominal_stress_Pa(solid.law, Deformation::kUniaxial, history[step].value);
      const double* row = &rows[3 * (step - 1)];
      CHECK(row[0] == Approx(at_once_MPa).epsilon(2e-6));
      CHECK(row[1] == Approx(1e-6 * exact_Pa[step]).epsilon(2e-6));
      CHECK(row[2] == Approx(1e-6 * exact_Pa[step]).epsilon(1e-10));
    }
  }
}
