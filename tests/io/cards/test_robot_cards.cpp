// Cards for robots: their text is read here without viscard's readers, and evaluated by the formulas
// of the simulators' sources.
#include "io/cards/card.h"
#include "io/cards/targets/card_targets.h"
#include "models/material/frequency_band.h"
#include "tests/io/cards/card_materials.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <complex>
#include <numbers>
#include <sstream>

using namespace viscard;
using namespace viscard::test;
using Catch::Contains;

namespace {

std::vector<double> parameter_set(const std::string& text) {
  const std::string mark = "ParameterSet=\"";
  const std::size_t at = text.find(mark);
  REQUIRE(at != std::string::npos);
  std::istringstream stream(text.substr(at + mark.size()));
  std::vector<double> out;
  for (double value = 0.0; stream >> value;) out.push_back(value);
  return out;
}

// SLSMaxwellSecondOrder.h of the plugin for diagonal small strains: stress 2 G0 dev E +
// 2 G1 (E - V1) + 2 G2 (dev E - V2) + last tr E, V by backward Euler to dev E.
class SofaPoint {
 public:
  explicit SofaPoint(std::vector<double> set) : set_(std::move(set)) {}

  // The stress in z at the end of a step to the strain in z, the sides free.
  double pulled(double dt, double strain_z) {
    // S_x and S_z are linear in the strains; E_x from S_x = 0.
    const std::vector<double> at_zero = stress(dt, 0.0, strain_z),
                              at_one = stress(dt, 1.0, strain_z);
    const double strain_x = -at_zero[0] / (at_one[0] - at_zero[0]);
    const double out = stress(dt, strain_x, strain_z)[1];
    advance(dt, strain_x, strain_z);
    return out;
  }
  std::vector<double> stress(double dt, double x, double z) const {
    const double trace = 2.0 * x + z;
    const double strain[2] = {x, z};
    std::vector<double> out;
    for (int axis = 0; axis < 2; ++axis) {
      const double deviator = strain[axis] - trace / 3.0;
      double sum = 2.0 * set_[0] * deviator + set_.back() * trace;
      sum += 2.0 * set_[1] * (strain[axis] - viscous(0, axis, dt, deviator));
      if (set_.size() > 4) sum += 2.0 * set_[3] * (deviator - viscous(1, axis, dt, deviator));
      out.push_back(sum);
    }
    return out;
  }

 private:
  double viscous(int branch, int axis, double dt, double deviator) const {
    const double ratio = set_[static_cast<std::size_t>(2 * branch + 2)] / dt;
    return (ratio * viscous_[branch][axis] + deviator) / (1.0 + ratio);
  }
  void advance(double dt, double x, double z) {
    const double trace = 2.0 * x + z;
    const double strain[2] = {x, z};
    for (int branch = 0; branch < (set_.size() > 4 ? 2 : 1); ++branch) {
      for (int axis = 0; axis < 2; ++axis) {
        viscous_[branch][axis] = viscous(branch, axis, dt, strain[axis] - trace / 3.0);
      }
    }
  }

  std::vector<double> set_;
  double viscous_[2][2] = {};
};

}  // namespace

TEST_CASE("the SOFA card, integrated as the plugin does, relaxes as the material", "[cards]") {
  Material material = reference_material();
  material.nu = 0.3;  // where the bulk term of the first branch counts
  material.terms = {{0.3, 0.0, 0.5}, {0.2, 0.0, 4.0}};
  for (const std::size_t n : {std::size_t{1}, std::size_t{2}}) {
    material.terms.resize(n);
    const std::string text = write_card(material, card_target("sofa"), {.units = "SI"}).text;
    const std::vector<double> set = parameter_set(text);
    REQUIRE(set.size() == 2 * n + 2);
    CHECK_THAT(text, Contains(n == 1 ? "\"SLSMaxwellFirstOrder\"" : "\"SLSMaxwellSecondOrder\""));
    const PronySeries exact = young_series(material);
    for (const double t : {0.5, 2.0}) {
      // First order in the step: extrapolated from two steps, the rest is of second order.
      double answers[2] = {};
      for (int i = 0; i < 2; ++i) {
        const int steps = 4000 << i;
        SofaPoint point(set);
        for (int step = 0; step < steps; ++step) answers[i] = point.pulled(t / steps, 1.0);
      }
      const double expected_Pa = relaxation_modulus_Pa(exact, t);
      CHECK(2.0 * answers[1] - answers[0] == Approx(expected_Pa).epsilon(1e-6));
      CHECK(std::abs(answers[0] / expected_Pa - 1.0) < 1e-3);
    }
    // Under pressure alone the stress is K times the volume strain, at once and for ever.
    SofaPoint point(set);
    const double K_Pa = material.E0_Pa / (3.0 * (1.0 - 2.0 * material.nu));
    CHECK(point.stress(1.0, 1.0, 1.0)[0] == Approx(3.0 * K_Pa).epsilon(1e-12));
    material.terms = {{0.3, 0.0, 0.5}, {0.2, 0.0, 4.0}};
  }
}

TEST_CASE("a SOFA card of an elastic material, and one of too many terms", "[cards]") {
  Material material = reference_material();
  material.terms.clear();
  const std::string text = write_card(material, card_target("sofa"), {.units = "SI"}).text;
  CHECK_THAT(text, Contains("\"LinearElastic\"") && Contains("massDensity=\"965\""));
  const std::vector<double> set = parameter_set(text);
  REQUIRE(set.size() == 2);
  CHECK(set[0] == Approx(1.88e6 / 2.99).epsilon(1e-14));  // G
  CHECK(set[1] == Approx(1.88e6 / 0.03).epsilon(1e-12));  // K
  CHECK_THROWS_WITH(write_card(material_of_terms(3, 0.4), card_target("sofa")),
                    Contains("at most 2"));
}

TEST_CASE("MuJoCo and PhysX cards state how far their damping is from the material's", "[cards]") {
  const Material material = material_of_terms(9, 0.4);
  const CardOptions options{.units = "SI", .band = FrequencyBand{10.0, 1000.0}};
  const auto after = [](const std::string& text, const std::string& mark) {
    const std::size_t at = text.find(mark);
    REQUIRE(at != std::string::npos);
    return std::stod(text.substr(at + mark.size()));
  };
  for (const char* target : {"mujoco", "physx"}) {
    CAPTURE(target);
    const bool is_physx = std::string(target) == "physx";
    const std::string text = write_card(material, card_target(target), options).text;
    const double E = after(text, is_physx ? "youngsModulus = " : "young=\"");
    const double beta = after(text, is_physx ? "elasticityDamping = " : "damping=\"");
    // Both simulators: stress = C (strain + beta strain rate), so E (1 + i omega beta).
    double loss = 0.0, storage = 0.0;
    for (int i = 0; i <= 4000; ++i) {
      const double f = 10.0 * std::pow(100.0, i / 4000.0), omega = 2.0 * std::numbers::pi * f;
      std::complex<double> exact = 1.0;
      for (const MaterialTerm& term : material.terms) {
        exact -= term.g / (1.0 + std::complex<double>(0.0, omega * term.tau_s));
      }
      loss = std::max(loss, std::abs(omega * beta - exact.imag() / exact.real()));
      storage = std::max(storage, std::abs(E / (material.E0_Pa * exact.real()) - 1.0));
    }
    // The header has two digits.
    CHECK(after(text, "omega times damping is off by up to ") == Approx(loss).epsilon(0.05));
    CHECK(after(text, "E' differs from the constant E by up to ") == Approx(storage).epsilon(0.05));
    CHECK(text.find("CANNOT REPRESENT: relaxation and creep") < 250);
  }
}
