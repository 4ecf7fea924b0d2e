#include "models/answer/error_control.h"
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

// A stress at a point converges with the degree alone, and 1e-5 may lie beyond the finest mesh: an answer
// then claims no more than it holds, beside degree 12 with 7 layers.
TEST_CASE("stresses at tight tolerances lie within their error estimate", "[pillar]") {
  PillarScene scene = pillar_scene();
  scene.pillar.nu = GENERATE(0.33, 0.45, 0.49, 0.4999);
  scene.tolerance = 6e-5;
  const SceneAnswer answer = simulate_pillar(scene);
  const SceneAnswer fine =
      pillar_answer_on(scene, {.degree = 12, .layers = 7, .shaft_elements = 1});
  const SceneResult& stress = result_of(answer, "base_stress_at_half_radius");
  CAPTURE(scene.pillar.nu, answer.discretisation.degree);
  CHECK(std::abs(stress.value - result_of(fine, "base_stress_at_half_radius").value) <=
        stress.error_estimate);
}

// Without layers at the rim of the top the error was up to 1.44 times its estimate.
TEST_CASE("a sheared pillar lies within its error estimate", "[pillar]") {
  PillarScene scene = pillar_scene();
  scene.pillar.nu = GENERATE(0.0, 0.4);
  scene.geometry.length_m = GENERATE(3.0, 10.0) * scene.geometry.diameter_m;
  StaticDrive drive;
  drive.direction = LoadDirection::kLateral;
  drive.pressure_Pa = 1.0;
  scene.drive = drive;
  scene.tolerance = 1e-5;
  const SceneResult finest = result_of(simulate_pillar(scene), "top_displacement");
  for (const double tolerance : {1e-3, 7e-4, 1e-4}) {
    scene.tolerance = tolerance;
    const SceneResult top = result_of(simulate_pillar(scene), "top_displacement");
    CAPTURE(scene.pillar.nu, tolerance, top.value, finest.value, top.error_estimate);
    CHECK(std::abs(top.value - finest.value) <= top.error_estimate + finest.error_estimate);
  }
}

TEST_CASE("a mesh for which there is no memory is refused before it is made", "[pillar]") {
  const Discretisation mesh{.degree = 8, .uniform_m = 1e-8};  // 1.5e9 nodes
  CHECK_THROWS_WITH(pillar_answer_on(pillar_scene(), mesh),
                    Catch::Contains("unknowns, which need about") && Catch::Contains("GB"));
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

TEST_CASE("the error of a mesh that is named is its own", "[pillar]") {
  PillarScene scene = pillar_scene();
  scene.drive = ModalDrive{.modes = 2};
  const SceneAnswer exact = pillar_answer_on(scene, {.degree = 9, .layers = 5});
  scene.tolerance = 0.5;
  scene.discretisation = GENERATE(
      Discretisation{.degree = 4, .layers = 2}, Discretisation{.degree = 3, .layers = 1},
      Discretisation{.degree = 7, .layers = 3}, Discretisation{.degree = 1, .uniform_m = 5e-6},
      Discretisation{.degree = 2, .uniform_m = 10e-6});
  const SceneAnswer answer = simulate_pillar(scene);
  CAPTURE(answer.discretisation.degree, answer.discretisation.layers);
  for (std::size_t i = 0; i < exact.modes.size(); ++i) {
    const SceneMode& mode = answer.modes[i];
    const double error_Hz = std::abs(mode.frequency_Hz - exact.modes[i].frequency_Hz);
    CAPTURE(mode.family, error_Hz, mode.error_estimate);
    CHECK(error_Hz <= mode.error_estimate + 1e-7 * mode.frequency_Hz);
    CHECK(mode.error_estimate <= 3.0 * error_Hz + 1e-6 * mode.frequency_Hz);
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

TEST_CASE("near buckling the growth of a bow is stated", "[pillar]") {
  PillarScene scene = pillar_scene();
  scene.tolerance = 1e-2;
  scene.drive = BucklingDrive{};
  const double critical_Pa = simulate_pillar(scene).results.front().value;
  scene.drive = StaticDrive{.pressure_Pa = 0.4 * critical_Pa};
  CHECK(simulate_pillar(scene).notes.empty());
  scene.drive = StaticDrive{.pressure_Pa = 0.75 * critical_Pa};
  const SceneAnswer answer = simulate_pillar(scene);
  REQUIRE(answer.notes.size() == 1);
  CHECK_THAT(answer.notes.front(), Catch::Contains("a bow") && Catch::Contains(" 4 times"));
}

TEST_CASE("modes under a pressure near buckling are judged by the pillar, not by a coarse mesh",
          "[pillar]") {
  PillarScene scene = pillar_scene();
  scene.pillar.E0_Pa = 1.88e6;
  scene.pillar.nu = 0.495;
  scene.tolerance = 0.2;
  // Converged by degrees 5 to 6 and 3 to 6 layers; a mesh of degree 3 with one layer buckles at
  // 30.76 kPa, one of degree 4 at 31.00.
  constexpr double kPillarBuckles_Pa = 31209.0;
  scene.drive = ModalDrive{.modes = 1, .pressure_Pa = 30.9e3};
  const SceneMode lateral = simulate_pillar(scene).modes.front();
  const double free_Hz = 16280.0 * std::sqrt(1.88 / 1.8);  // between nu = 0.49 and 0.499
  // Rayleigh's quotient: at least sqrt(1 - p/p_cr), a little more because the shapes differ.
  const double least_Hz = free_Hz * std::sqrt(1.0 - 30.9e3 / kPillarBuckles_Pa);
  CHECK(lateral.frequency_Hz + lateral.error_estimate > least_Hz);
  CHECK(lateral.frequency_Hz - lateral.error_estimate < 1.07 * least_Hz);
  const auto on_mesh = [&](double pressure_Pa) {
    scene.drive = ModalDrive{.modes = 1, .pressure_Pa = pressure_Pa};
    pillar_answer_on(scene, {.degree = 3, .layers = 1});
  };
  CHECK_THROWS_AS(on_mesh(31.1e3), MeshTooCoarse);
  CHECK_THROWS_WITH(on_mesh(31.3e3), Catch::Contains("beyond the buckling pressure"));
}

TEST_CASE("modes under a pressure at nu near 0.5 take few unknowns", "[pillar]") {
  PillarScene scene = pillar_scene();
  scene.pillar.E0_Pa = 1.88e6;
  scene.pillar.nu = 0.495;
  scene.drive = ModalDrive{.modes = 3, .pressure_Pa = 25e3};
  scene.tolerance = 1e-2;
  const SceneAnswer answer = simulate_pillar(scene);
  // With degree 6 and 6 layers, degrees 5 to 8 and 4 to 6 layers agree to 1e-5.
  const double expected_Hz[] = {7793.48, 70685.0, 166096.5, 93371.0, 270653.0, 421115.0};
  for (std::size_t i = 0; i < 6; ++i) {
    const SceneMode& mode = answer.modes[i];
    CHECK(std::abs(mode.frequency_Hz - expected_Hz[i]) <=
          mode.error_estimate + 1e-5 * expected_Hz[i]);
  }
  CHECK(answer.unknowns < 1500);  // 5432 on the meshes of other answers, degree 8
}

TEST_CASE("buckling under a plate is found beside local modes of the rim at nu = 0.5", "[pillar]") {
  PillarScene scene = pillar_scene();
  scene.pillar.E0_Pa = 1.88e6;
  scene.pillar.nu = 0.5;
  scene.drive = BucklingDrive{.plate_on_top = true};
  scene.tolerance = 1e-2;
  const SceneResult rough = simulate_pillar(scene).results.front();
  // Engesser's pressure of a beam clamped at both ends whose top may move sideways.
  CHECK(rough.value == Approx(104.9e3).epsilon(0.05));
  scene.tolerance = 1e-3;  // refused before: "no buckling load of the whole pillar was found"
  const SceneAnswer fine = simulate_pillar(scene);
  CHECK(std::abs(fine.results.front().value - rough.value) <= rough.error_estimate);
  CHECK(fine.unknowns < 6000);
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
