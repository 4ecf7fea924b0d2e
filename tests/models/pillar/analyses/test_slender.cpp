// Modes of pillars so slender that rounding competes with their stiffness against bending.
#include "models/pillar/analyses/analysis.h"
#include "models/pillar/analyses/buckling_limit.h"
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

TEST_CASE("modes and buckling of pillars of 200 and 400 diameters are a beam's to 1e-4",
          "[pillar][stability]") {
  const double diameters = GENERATE(200.0, 400.0);
  const double nu = GENERATE(0.0, 0.49);
  PillarScene scene = slender_scene(diameters);
  scene.pillar.nu = nu;
  scene.tolerance = 1e-4;
  CAPTURE(diameters, nu);
  // The clamped contraction stiffens the foot over a tenth of a diameter.
  const double of_foot = nu == 0.0 ? 0.0 : 0.2 / diameters;
  const double found_Hz = lateral_Hz(scene, {.degree = 6, .layers = 2, .shaft_elements = 40});
  CHECK(found_Hz == Approx(euler_Hz(scene)).epsilon(3e-5 + of_foot));
  for (const bool has_plate : {false, true}) {
    scene.drive = BucklingDrive{.plate_on_top = has_plate};
    const SceneResult load = simulate_pillar(scene).results.front();
    const TopEnd end = has_plate ? TopEnd::kSlides : TopEnd::kFree;
    CAPTURE(load.value, engesser_pressure_Pa(scene, end));
    CHECK(load.error_estimate <= 1e-4 * load.value);
    CHECK(load.value == Approx(engesser_pressure_Pa(scene, end)).epsilon(5e-5 + 2.0 * of_foot));
  }
}

TEST_CASE("a pillar 3000 diameters long is pressed up to a beam's buckling load",
          "[pillar][stability]") {
  PillarScene scene = slender_scene(3000.0);
  const double euler_Pa = std::pow(std::numbers::pi / 3000.0, 2) * 1.8e6 / 64.0;
  scene.drive = StaticDrive{.pressure_Pa = 0.98 * euler_Pa};
  const SceneAnswer answer = simulate_pillar(scene);
  const double shortened_m = 0.98 * euler_Pa / 1.8e6 * scene.geometry.length_m;
  CHECK(answer.results.front().value == Approx(-shortened_m).epsilon(1e-3));
  scene.drive = StaticDrive{.pressure_Pa = 1.02 * euler_Pa};
  CHECK_THROWS_WITH(simulate_pillar(scene), Catch::Contains("buckling"));
}

TEST_CASE("a pillar too slender for any correction is refused with a way out",
          "[pillar][stability]") {
  PillarScene scene = slender_scene(3e4);
  scene.drive = BucklingDrive{};
  scene.tolerance = 1e-5;
  CHECK_THROWS_WITH(simulate_pillar(scene), Catch::Contains("a beam"));
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
