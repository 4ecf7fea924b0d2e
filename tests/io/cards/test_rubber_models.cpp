// Cards of laws of rubber that are a part of a model's text: SfePy itself, and MOOSE's energy by a
// second implementation.
#include "io/cards/hyperelastic/rubber_card.h"
#include "tests/io/cards/sfepy_cube.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <cstdlib>

using namespace viscard;
using Catch::Matchers::Contains;
using viscard::test::has_sfepy;
using viscard::test::numbers_from_sfepy;

namespace {

HyperelasticLaw rubber(HyperelasticForm form, const std::vector<double>& moduli_Pa,
                       const std::vector<double>& shapes) {
  const auto vector = [](const std::vector<double>& from) {
    return Eigen::VectorXd(
        Eigen::Map<const Eigen::VectorXd>(from.data(), static_cast<Eigen::Index>(from.size())));
  };
  return {form, vector(moduli_Pa), vector(shapes)};
}

const HyperelasticLaw& neo_hooke() {
  static const HyperelasticLaw kLaw = rubber(HyperelasticForm::kNeoHooke, {2e5}, {});
  return kLaw;
}

const HyperelasticLaw& mooney_rivlin() {
  static const HyperelasticLaw kLaw = rubber(HyperelasticForm::kMooneyRivlin, {1.5e5, 2e4}, {});
  return kLaw;
}

std::string model_card(const HyperelasticLaw& law, const char* target, double bulk_Pa) {
  return rubber_card(
      law, {.target = target, .units = "mm-t-s", .bulk_Pa = bulk_Pa, .density_kg_m3 = 1100.0});
}

// Nominal stresses of a cube of one element with the card's bulk modulus and with twice of it, in the order of
// Deformation.
constexpr const char* kThreeStretches = R"python(import numpy as np
import cube

ramp = np.linspace(1.0, 1.8, 6)[1:]
for mode in ("uniaxial", "planar", "equibiaxial"):
    for factor in (1.0, 2.0):
        print(repr(float(cube.stresses(mode, ramp, factor)[-1])))
)python";

// The number behind "name = " in MOOSE's input.
double parameter(const std::string& text, const std::string& name) {
  const std::size_t at = text.find(" " + name + " = ");
  REQUIRE(at != std::string::npos);
  return std::strtod(text.c_str() + at + name.size() + 4, nullptr);
}

// Nominal stress in tension of S = (lambda ln J - mu) C^-1 + mu I with free sides, which are found by
// bisection.
double moose_tension(double lambda, double mu, double stretch) {
  const auto side_stress = [&](double side) {
    return (lambda * std::log(stretch * side * side) - mu) / (side * side) + mu;
  };
  double low = 0.1, high = 1.5;
  for (int i = 0; i < 200; ++i) {
    const double middle = 0.5 * (low + high);
    (side_stress(middle) < 0.0 ? low : high) = middle;
  }
  return stretch * ((lambda * std::log(stretch * low * low) - mu) / (stretch * stretch) + mu);
}

}  // namespace

TEST_CASE("rubber cards: SfePy gives the nominal stress of the law in every deformation", "[io]") {
  if (!has_sfepy()) return;
  const double stretch = 1.8;
  for (const HyperelasticLaw& law :
       {neo_hooke(), mooney_rivlin(), rubber(HyperelasticForm::kYeoh, {1.8e5, -1.4e3, 40.0}, {}),
        rubber(HyperelasticForm::kOgden3, {3.45e5, 6.2e3, 4.2}, {1.9, -2.2, 8.5})}) {
    const double shear_Pa = youngs_modulus_Pa(law) / 3.0;
    const std::vector<double> all_MPa =
        numbers_from_sfepy(model_card(law, "sfepy", 4e3 * shear_Pa), kThreeStretches);
    REQUIRE(all_MPa.size() == 6);
    for (std::size_t i = 0; i < 3; ++i) {
      const auto deformation = static_cast<Deformation>(i);
      CAPTURE(name_of(law.form), name_of(deformation));
      const double soft_MPa = all_MPa[2 * i], hard_MPa = all_MPa[2 * i + 1];
      const double exact_MPa = 1e-6 * nominal_stress_Pa(law, deformation, stretch);
      // Extrapolated to an incompressible body.
      CHECK(2.0 * hard_MPa - soft_MPa == Approx(exact_MPa).epsilon(2e-6));
      CHECK(soft_MPa == Approx(exact_MPa).epsilon(1e-3));
    }
  }
}

TEST_CASE("rubber cards: MOOSE's own energy with the card's numbers gives the law's stress",
          "[io]") {
  const double stretch = 1.8, shear_Pa = 4e5;
  const auto stress_MPa = [&](double ratio) {
    const std::string card = model_card(neo_hooke(), "moose", ratio * shear_Pa);
    const double lambda = parameter(card, "lambda"), mu = parameter(card, "mu");
    CHECK(lambda + 2.0 * mu / 3.0 == Approx(1e-6 * ratio * shear_Pa).epsilon(1e-12));
    return moose_tension(lambda, mu, stretch);
  };
  const double exact_MPa = 1e-6 * nominal_stress_Pa(neo_hooke(), Deformation::kUniaxial, stretch);
  CHECK(2.0 * stress_MPa(8e3) - stress_MPa(4e3) == Approx(exact_MPa).epsilon(2e-6));
  CHECK_THAT(model_card(neo_hooke(), "moose", 2e9), Contains("type = ComputeNeoHookeanStress") &&
                                                        Contains("large_kinematics = true") &&
                                                        Contains("prop_values = '1.1e-09'"));
}

TEST_CASE("rubber cards: COMSOL's parameters carry their units", "[io]") {
  CHECK(model_card(neo_hooke(), "comsol", 2e9) ==
        "RUBBER_mu 0.4[MPa] \"Neo-Hookean, Lame parameter mu\"\n"
        "RUBBER_kappa 2000[MPa] \"bulk modulus, nearly incompressible material\"\n"
        "RUBBER_rho 1.1e-09[t/mm^3] \"density\"\n");
  CHECK_THAT(model_card(mooney_rivlin(), "comsol", 2e9),
             Contains("RUBBER_C10 0.15[MPa]") && Contains("RUBBER_C01 0.02[MPa]"));
}

// Its energies: mu/2 (I1 - 3), and C10 (I1 - 3) + C01 (I2 - 3), of isochoric invariants (User's Guide, Hyperelastic
// Material, Neo-Hookean and Mooney-Rivlin, two parameters).
TEST_CASE("rubber cards: COMSOL's energies with the card's numbers give the law's stress", "[io]") {
  const double s = 1.7;
  const auto number = [](const std::string& card, const std::string& name) {
    const std::size_t at = card.find("RUBBER_" + name + " ");
    REQUIRE(at != std::string::npos);
    return std::strtod(card.c_str() + at + name.size() + 8, nullptr);
  };
  const auto exact_MPa = [&](const HyperelasticLaw& law) {
    return 1e-6 * nominal_stress_Pa(law, Deformation::kUniaxial, s);
  };
  CHECK(number(model_card(neo_hooke(), "comsol", 2e9), "mu") * (s - 1.0 / (s * s)) ==
        Approx(exact_MPa(neo_hooke())).epsilon(1e-12));
  const std::string card = model_card(mooney_rivlin(), "comsol", 2e9);
  CHECK(2.0 * (s - 1.0 / (s * s)) * (number(card, "C10") + number(card, "C01") / s) ==
        Approx(exact_MPa(mooney_rivlin())).epsilon(1e-12));
}

TEST_CASE("rubber cards: laws that SfePy, MOOSE or COMSOL cannot take are refused", "[io]") {
  const HyperelasticLaw chains = rubber(HyperelasticForm::kArrudaBoyce, {2.7e5}, {3.2});
  CHECK_THROWS_WITH(model_card(chains, "sfepy", 2e9), Contains("sfepy has no arruda-boyce law"));
  CHECK_THROWS_WITH(model_card(mooney_rivlin(), "moose", 2e9),
                    Contains("moose has no mooney-rivlin law"));
  CHECK_THROWS_WITH(model_card(chains, "comsol", 2e9), Contains("comsol has no arruda-boyce law"));
}
