// Modes of pillars so slender that rounding competes with their stiffness against bending.
#include "models/pillar/analyses/analysis.h"
#include "models/pillar/analyses/simulate_pillar.h"
#include "models/pillar/analyses/slender_rounding.h"
#include "models/pillar/body/pillar_model.h"
#include "models/pillar/body/pillar_modes.h"
#include "models/pillar/scene/pillar_scene.h"
#include "tests/models/pillar/drive_as.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

using namespace viscard;
using namespace viscard::test;

namespace {

PillarScene slender_scene(double diameters) {
  PillarScene scene;
  scene.geometry.diameter_m = 40e-6;
  scene.geometry.length_m = diameters * 40e-6;
  scene.pillar.E0_Pa = 1.8e6;
  scene.pillar.nu = .33;
  scene.pillar.rho_kg_m3 = 965.0;
  scene.tolerance = 1e-3;
  scene.drive = ModalDrive{.modes = 1};
  return scene;
}

double euler_Hz(const PillarScene& scene) {
  return 3.5160153 / (2.0 * std::numbers::pi) * 0.25 * scene.geometry.diameter_m *
         std::sqrt(scene.pillar.E0_Pa / scene.pillar.rho_kg_m3) /
         std::pow(scene.geometry.length_m, 2);
}

double lateral_Hz(const PillarScene& scene, const Discretisation& mesh) {
  return lowest_modes(model_of(scene, Motion::kLateral, mesh), 1).front().frequency_Hz;
}

}  // namespace

TEST_CASE("a pillar 300 diameters long vibrates as a beam, within its claim",
          "[pillar][stability]") {
  const PillarScene scene = slender_scene(300.0);
  const SceneAnswer answer = simulate_pillar(scene);
  const SceneMode& lateral = answer.modes.front();
  REQUIRE(lateral.family == "lateral");
  CHECK(lateral.error_estimate <= scene.tolerance * lateral.frequency_Hz);
  // The clamped contraction stiffens the foot over a tenth of a diameter.
  const double of_beam = 0.1 / 300.0 * euler_Hz(scene);
  CHECK(std::abs(lateral.frequency_Hz - euler_Hz(scene)) <= lateral.error_estimate + of_beam);
}

TEST_CASE("a pillar too slender is refused for its rounding, with a tolerance that works",
          "[pillar][stability]") {
  PillarScene scene = slender_scene(300.0);
  scene.tolerance = 1e-5;
  std::string refusal;
  try {
    simulate_pillar(scene);
  } catch (const std::runtime_error& error) {
    refusal = error.what();
  }
  CAPTURE(refusal);
  REQUIRE_THAT(refusal, Catch::StartsWith("rounding in a pillar 300 diameters long"));
  const std::string before = "ask for a tolerance of ";
  scene.tolerance = std::stod(refusal.substr(refusal.find(before) + before.size()));
  CHECK(simulate_pillar(scene).largest_relative_error <= scene.tolerance);
}

TEST_CASE("the rounding of thin elements is within its estimate", "[pillar][stability]") {
  PillarScene scene = slender_scene(6.4);
  scene.tolerance = 1e-7;  // so that even small estimates are made
  for (const int degree : {5, 8}) {
    // A layer more changes a frequency by far less than the rounding of its thin elements.
    const double exact_Hz = lateral_Hz(scene, {.degree = degree, .layers = 5});
    for (const int layers : {7, 8}) {
      const Discretisation mesh{.degree = degree, .layers = layers};
      const double rounding = bending_rounding(scene, mesh);
      const double error = std::abs(lateral_Hz(scene, mesh) / exact_Hz - 1.0);
      CAPTURE(degree, layers, error, rounding);
      CHECK(error <= rounding);
      CHECK(rounding <= 1e-3);
    }
  }
  const Discretisation coarse{.degree = 5, .layers = 3};
  CHECK(bending_rounding(scene, coarse) < 1e-6);
}
