#include "models/pillar/analyses/simulate_pillar.h"
#include "models/pillar/scene/pillar_scene.h"
#include "tests/models/pillar/drive_as.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace viscard;

namespace {

PillarScene pillar_scene() {
  PillarScene scene;
  scene.pillar.E0_Pa = 1.8e6;
  scene.pillar.nu = 0.33;
  scene.pillar.rho_kg_m3 = 965.0;
  test::as<StaticDrive>(scene).pressure_Pa = 1e4;
  return scene;
}

const SceneResult& result_of(const SceneAnswer& answer, const std::string& name) {
  for (const SceneResult& result : answer.results) {
    if (result.name == name) return result;
  }
  throw std::runtime_error("no result " + name);
}

}  // namespace

TEST_CASE("static answers lie within their error estimate, and that within the tolerance",
          "[pillar]") {
  PillarScene scene = pillar_scene();
  scene.tolerance = GENERATE(1e-2, 1e-3, 1e-4);
  const SceneAnswer answer = simulate_pillar(scene);
  const SceneResult& top = result_of(answer, "top_displacement");
  CHECK(std::abs(top.value + 659.692e-9) <= top.error_estimate + 0.001e-9);  // last digit known
  const SceneResult& base = result_of(answer, "base_stress_at_half_radius");
  CHECK(base.error_estimate <= scene.tolerance * std::abs(base.value));
}

TEST_CASE("modal answers lie within their error estimates", "[pillar]") {
  PillarScene scene = pillar_scene();
  scene.drive = ModalDrive{.modes = 2};
  const SceneAnswer answer = simulate_pillar(scene);
  const std::vector<double> expected_Hz = {16029.18, 77413.28, 90769.96, 268168.4,
                                           55168.42, 165505.3, 449529.6, 493537.6};
  REQUIRE(answer.modes.size() == expected_Hz.size());
  for (std::size_t i = 0; i < expected_Hz.size(); ++i) {
    CAPTURE(i);
    CHECK(std::abs(answer.modes[i].frequency_Hz - expected_Hz[i]) <=
          answer.modes[i].error_estimate + 0.05);  // last digit known
  }
}

TEST_CASE("a smaller tolerance needs no fewer unknowns", "[pillar]") {
  PillarScene scene = pillar_scene();
  scene.tolerance = 1e-1;
  const int few = simulate_pillar(scene).unknowns;
  scene.tolerance = 1e-4;
  CHECK(simulate_pillar(scene).unknowns > few);
}

TEST_CASE("a load beyond buckling is refused with the buckling pressure", "[pillar]") {
  PillarScene scene = pillar_scene();
  test::as<StaticDrive>(scene).pressure_Pa = 3.2e4;  // the critical pressure is 29.37 kPa
  CHECK_THROWS_WITH(simulate_pillar(scene), Catch::Contains("buckling pressure"));
  test::as<StaticDrive>(scene).pressure_Pa = 2.8e4;
  CHECK_NOTHROW(simulate_pillar(scene));
}

TEST_CASE("contradictory scenes are refused with the key", "[pillar]") {
  PillarScene scene = pillar_scene();
  SECTION("no load") {
    test::as<StaticDrive>(scene).pressure_Pa = 0.0;
    CHECK_THROWS_WITH(simulate_pillar(scene), Catch::Contains("pressure"));
  }
  SECTION("tolerance of nothing") {
    scene.tolerance = 0.0;
    CHECK_THROWS_WITH(simulate_pillar(scene), Catch::Contains("tolerance"));
  }
  SECTION("an electrode without a film") {
    scene.electrodes = ElectrodeOptions{};
    CHECK_THROWS_WITH(simulate_pillar(scene), Catch::Contains("film"));
  }
  SECTION("creep without a history") {
    scene.drive = CreepDrive{};
    CHECK_THROWS_WITH(simulate_pillar(scene), Catch::Contains("history"));
  }
  SECTION("no density") {
    scene.drive = ModalDrive{};
    scene.pillar.rho_kg_m3 = 0.0;
    CHECK_THROWS_WITH(simulate_pillar(scene), Catch::Contains("density"));
  }
}

TEST_CASE("a load beyond buckling is refused unless the scene holds its pillar straight",
          "[pillar]") {
  PillarScene scene;
  scene.pillar.E0_Pa = 1.8e6;
  scene.pillar.nu = .33;
  scene.drive = StaticDrive{};
  test::as<StaticDrive>(scene).pressure_Pa = 35e3;  // buckles at 29.37 kPa
  CHECK_THROWS_WITH(simulate_pillar(scene), Catch::Contains("beyond the buckling pressure") &&
                                                Catch::Contains("geometric_stiffness"));
  scene.effects["geometric_stiffness"] = EffectChoice::kOff;
  const SceneAnswer answer = simulate_pillar(scene);
  REQUIRE(answer.notes.size() == 1);
  CHECK_THAT(answer.notes[0], Catch::Contains("held straight"));
  // Linear: 659.69 nm at 10 kPa.
  CHECK(answer.results[0].value == Approx(-3.5 * 659.692e-9).epsilon(1e-3));
}
