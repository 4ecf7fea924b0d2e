#include "models/material/liquid.h"
#include "models/material/material.h"
#include "models/material/prediction.h"
#include "tests/support/printed_digits.h"

#include <catch2/catch.hpp>

using namespace viscard;

namespace {
Material reference_material(bool constant_bulk) {
  Material material;
  material.E0_Pa = 1.88e6;
  material.nu = 0.495;
  material.rho_kg_m3 = 965.0;
  material.terms = {{0.008206, 0.008206, 0.1945}, {0.01386, 0.01386, 2.403}};
  if (constant_bulk) {
    for (MaterialTerm& term : material.terms) term.k = 0.0;
  }
  return material;
}
}  // namespace

TEST_CASE("derived moduli of the reference material equal the published ones", "[models]") {
  const DerivedModuli moduli = derived_moduli(reference_material(false));
  CHECK(moduli.sum_g == Approx(0.022066).epsilon(1e-14));
  CHECK(moduli.E_inf_Pa == Approx(1.83851592e6).epsilon(1e-12));
  CHECK(moduli.G0_Pa == Approx(0.6287625418e6).epsilon(1e-10));
  CHECK(moduli.G_inf_Pa == Approx(0.6148882676e6).epsilon(1e-10));
  CHECK(moduli.K0_Pa == Approx(62.6666667e6).epsilon(1e-9));
  CHECK(moduli.G_Pa[0] == Approx(0.00515962542e6).epsilon(1e-9));
  CHECK(moduli.G_Pa[1] == Approx(0.00871464883e6).epsilon(1e-9));
  CHECK(moduli.K_Pa[0] == Approx(0.514242667e6).epsilon(1e-9));
  CHECK(moduli.K_Pa[1] == Approx(0.86856e6).epsilon(1e-9));
  CHECK(moduli.beta_1_s[0] == Approx(5.141388175).epsilon(1e-10));
  CHECK(moduli.beta_1_s[1] == Approx(0.4161464836).epsilon(1e-10));
}

TEST_CASE("constant bulk modulus changes the long-term Young's modulus by 7.36e-5", "[models]") {
  const PronySeries young = young_series(reference_material(true));
  const PronySeries constant_nu = young_series(reference_material(false));
  CHECK(young.equilibrium_modulus_Pa / constant_nu.equilibrium_modulus_Pa - 1.0 ==
        Approx(7.36e-5).epsilon(2e-3));
  CHECK(instantaneous_modulus_Pa(young) == Approx(1.88e6).epsilon(1e-13));
  CHECK(derived_moduli(reference_material(true)).E_inf_Pa ==
        Approx(young.equilibrium_modulus_Pa).epsilon(1e-13));
}

TEST_CASE("one relaxing shear term makes one Young's term with its time stretched", "[models]") {
  // Constant K, g = 0.022066: tau_E/tau = (3K + G0)/(3K + G_inf) = 1.00250708 and
  // E_inf/E0 = 0.98038576 at nu = 0.33.
  Material material;
  material.E0_Pa = 1.8e6;
  material.nu = 0.33;
  material.terms = {{0.022066, 0.0, 2.0}};
  const PronySeries young = young_series(material);
  REQUIRE(young.terms.size() == 1);
  CHECK(young.terms[0].relaxation_time_s / 2.0 == test::printed("1.00250708"));
  CHECK(young.equilibrium_modulus_Pa / 1.8e6 == test::printed("0.98038576"));
}

TEST_CASE("unphysical materials are refused with their value", "[models]") {
  Material material = reference_material(false);
  material.terms[1].g = 0.995;
  CHECK_THROWS_WITH(validate(material), Catch::Contains("must be below 1"));
  material = reference_material(false);
  material.nu = 0.51;
  CHECK_THROWS_WITH(validate(material), Catch::Contains("Poisson"));
  material = reference_material(false);
  material.E0_Pa = std::nan("");
  CHECK_THROWS_WITH(validate(material), Catch::Contains("E0"));
  material = reference_material(false);
  material.terms[0].tau_s = 0.0;
  CHECK_THROWS_WITH(validate(material), Catch::Contains("term 1"));
  material = reference_material(false);
  material.nu = 0.5;  // a material may be incompressible; some cards may not
  CHECK_NOTHROW(validate(material));
}

TEST_CASE("Young's series of any bulk relaxation obeys 1/E = 1/(3G) + 1/(9K)", "[models]") {
  Material material = reference_material(false);
  material.nu = 0.3;
  material.terms = {{0.2, 0.05, 0.1}, {0.3, 0.0, 1.0}, {0.0, 0.2, 7.0}};
  const PronySeries young = young_series(material);
  // s times the Laplace transform at real s, where relaxing branches count M s tau/(1 + s tau).
  const DerivedModuli moduli = derived_moduli(material);
  for (const double s : {1e-3, 0.1, 0.9, 5.0, 400.0}) {
    double G_Pa = moduli.G_inf_Pa, K_Pa = moduli.K_inf_Pa, E_Pa = young.equilibrium_modulus_Pa;
    for (std::size_t i = 0; i < 3; ++i) {
      const double x = s * material.terms[i].tau_s;
      G_Pa += moduli.G_Pa[i] * x / (1.0 + x);
      K_Pa += moduli.K_Pa[i] * x / (1.0 + x);
    }
    for (const MaxwellTerm& term : young.terms) {
      const double x = s * term.relaxation_time_s;
      E_Pa += term.modulus_Pa * x / (1.0 + x);
    }
    CHECK(E_Pa == Approx(9.0 * K_Pa * G_Pa / (3.0 * K_Pa + G_Pa)).epsilon(1e-12));  // rounding
  }
}

TEST_CASE("shares that add up to 1 within rounding are a liquid with E_inf = 0", "[models]") {
  for (const double rounding : {-1e-13, 0.0, 4e-16, 1e-13}) {
    for (const double nu : {0.3, 0.495, 0.5}) {
      for (const double k_over_g : {0.0, 1.0}) {
        INFO("rounding " << rounding << ", nu " << nu << ", k/g " << k_over_g);
        Material material = reference_material(false);
        material.nu = nu;
        const double g = 0.6 + rounding;
        material.terms = {{0.4, k_over_g * 0.4, 0.1}, {g, k_over_g * g, 2.0}};
        CHECK_NOTHROW(validate(material));
        CHECK(is_liquid(material));
        CHECK_THROWS_WITH(validate_solid(material), Catch::Contains("liquid") &&
                                                        Catch::Contains("--solid") &&
                                                        Catch::Contains("viscard predict"));
        CHECK(derived_moduli(material).E_inf_Pa == 0.0);
        const PronySeries young = young_series(material);
        CHECK(std::abs(young.equilibrium_modulus_Pa) < 1e-9 * material.E0_Pa);
        CHECK(instantaneous_modulus_Pa(young) == Approx(material.E0_Pa));
        CHECK(std::abs(relative_modulus(material.terms, &MaterialTerm::g, 1e-30)) < 1e-20);
        // The strain of creep goes on growing at stress/eta.
        const TestPrediction creep = predict_test(
            material, {.test = PredictedTest::kCreep, .from = 1e4, .to = 2e4, .points = 2});
        double eta_Pa_s = 0.0;
        for (const MaxwellTerm& term : young.terms)
          eta_Pa_s += term.modulus_Pa * term.relaxation_time_s;
        const std::vector<double>& J_1_Pa = creep.curves.at(0).curve.value;
        CHECK((J_1_Pa.back() - J_1_Pa.front()) / 1e4 == Approx(1.0 / eta_Pa_s).epsilon(1e-6));
      }
    }
  }
  Material solid = reference_material(false);
  CHECK_FALSE(is_liquid(solid));
  CHECK_NOTHROW(validate_solid(solid));
  solid.terms = {{0.4, 0.0, 0.1}, {0.6 + 1e-8, 0.0, 2.0}};
  CHECK_THROWS_WITH(validate(solid), Catch::Contains("the g of all terms"));
  solid.terms = {{0.4, 1.0, 0.1}};
  CHECK_THROWS_WITH(validate(solid), Catch::Contains("the k of all terms"));
}
