#include "models/pillar/validate_material.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace viscard;

namespace {

// The seed's 1:10 PDMS.
Material pdms_1to10(double nu, double k_over_g) {
  Material material;
  material.E0_Pa = 1.88e6;
  material.nu = nu;
  material.terms = {{0.008206, 0.008206 * k_over_g, 0.1945}, {0.01386, 0.01386 * k_over_g, 2.403}};
  return material;
}

// Equal terms over twenty decades; `rest` of the modulus never relaxes.
Material thirty_terms(double nu, double k_over_g, double rest) {
  Material material;
  material.E0_Pa = 1e9;
  material.nu = nu;
  for (int i = 0; i < 30; ++i) {
    const double g = (1.0 - rest) / 30.0;
    material.terms.push_back({g, g * k_over_g, std::pow(10.0, -10.0 + 20.0 * i / 29.0)});
  }
  return material;
}

void check_passes(const Material& material) {
  const ValidationResult result = validate_material(material);
  CAPTURE(material.nu, result.relaxation.at_time_s, result.creep.at_time_s);
  CHECK(result.passed);
  CHECK(result.relaxation.largest_relative_error <= 1e-6);
  CHECK(result.creep.largest_relative_error <= 1e-6);
  CHECK(result.creep.time_s.size() > 50);
}

}  // namespace

TEST_CASE("the pillar relaxes and creeps by the correspondence principle", "[pillar]") {
  const double nu = GENERATE(0.0, 0.33, 0.45, 0.495, 0.4999, 0.5);
  const double k_over_g = GENERATE(0.0, 0.5, 1.0);
  check_passes(pdms_1to10(nu, k_over_g));
}

TEST_CASE("thirty terms over twenty decades pass, for a solid and for almost a liquid",
          "[pillar][stability]") {
  SECTION("constant Poisson ratio") {
    check_passes(thirty_terms(0.33, 1.0, 0.01));
  }
  SECTION("constant bulk modulus") {
    check_passes(thirty_terms(0.33, 0.0, 0.01));
  }
  SECTION("a millionth remains") {
    check_passes(thirty_terms(0.495, 1.0, 1e-6));
  }
}

TEST_CASE("a pillar that creeps by its own relaxation function fails the validation", "[pillar]") {
  // The bound is sharp: the curves end where E_inf says, and 1/E(t) is not J(t).
  const ValidationResult result = validate_material(pdms_1to10(0.33, 1.0));
  const auto& creep = result.creep;
  const double share = 1.0 - 0.008206 - 0.01386;
  CHECK(creep.solver.back() / creep.solver.front() == Approx(1.0 / share).epsilon(1e-5));
  double largest = 0.0;
  for (std::size_t i = 0; i < creep.time_s.size(); ++i) {
    const double t = creep.time_s[i];
    const double E = 1.0 - 0.008206 * -std::expm1(-t / 0.1945) - 0.01386 * -std::expm1(-t / 2.403);
    largest = std::max(largest, std::abs(creep.solver[i] / creep.solver.front() * E - 1.0));
  }
  CHECK(largest > 1e-5);
}

TEST_CASE("a material without terms is validated and reported as elastic", "[pillar]") {
  Material material;
  material.E0_Pa = 1e6;
  material.nu = 0.3;
  const ValidationResult result = validate_material(material);
  CHECK(result.passed);
  REQUIRE(result.notes.size() == 1);
  CHECK_THAT(result.notes[0], Catch::Contains("elastic"));
}

TEST_CASE("the validation refuses materials that it cannot run", "[pillar]") {
  Material material = pdms_1to10(0.33, 1.0);
  material.terms[0].g = 1.2;
  CHECK_THROWS_WITH(validate_material(material), Catch::Contains("below 1"));
  ValidateOptions options;
  options.geometry.length_m = -1.0;
  CHECK_THROWS_WITH(validate_material(pdms_1to10(0.33, 1.0), options), Catch::Contains("length"));
}

TEST_CASE("a validation states what is in doubt of the material", "[pillar]") {
  Material material = pdms_1to10(0.33, 1.0);
  material.flags = {{"edited", 0, "the file was edited"}, {"few-rows", 1, "of a term"}};
  const ValidationResult result = validate_material(material);
  REQUIRE(result.notes.size() == 1);
  CHECK(result.notes[0] == "edited: the file was edited");
}
