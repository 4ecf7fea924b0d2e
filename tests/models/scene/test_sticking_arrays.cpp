// Arrays in the plane whose tops stick to the shape: forces in three directions, notes and refusals.
#include "models/answer/scene_mistake.h"
#include "tests/models/scene/touches.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

using namespace viscard;
using namespace viscard::test;

namespace {

SpaceScene sticking_array(int rows, int columns, const RigidShape& shape, double depth_m) {
  SpaceScene scene = touched(rows, columns, shape, false, {{0.0, 0.0}, {1.0, 1e-6}});
  scene.touch.reset();
  scene.pillar.terms.clear();
  scene.press = ShapePress{.shape = shape, .depth_m = depth_m, .friction = Friction::kStick};
  return scene;
}

double on_top(const SceneAnswer& answer, const std::string& name, int row, int column) {
  return result_of(answer, name + "_" + std::to_string(row) + "_" + std::to_string(column));
}

std::string friction_refusal(const SpaceScene& scene) {
  try {
    simulate(scene);
  } catch (const SceneMistake& mistake) {
    return mistake.key() + ": " + mistake.what();
  }
  return "answered";
}

}  // namespace

// Between two planes that stick, a pillar is two halves under a plate that slides: 19.255 N/m instead of
// 19.047 N/m (models/array/contact, tests). The shear is that of a clamped beam whose top turns by the
// shape's slope and does not move, 6/(1 + phi) E I/l^2, phi = 12 E I/(kappa G A l^2), kappa = 0.89, which a
// pillar three diameters long meets to some per cent.
TEST_CASE("tops that stick to a paraboloid do not slide toward its rim", "[models][array][space]") {
  const double curvature_m = 3650e-6;
  const SceneAnswer answer = simulate(sticking_array(2, 2, paraboloid(curvature_m), 10e-6));
  const double mean_m = 10e-6 - (2.0 * 50e-6 * 50e-6 + 0.5 * 20e-6 * 20e-6) / (2.0 * curvature_m);
  CHECK(on_top(answer, "pillar_force", 1, 2) == Approx(19.255 * mean_m).epsilon(1e-3));
  const double EI_N_m2 = 1.8e6 * std::numbers::pi / 4.0 * std::pow(20e-6, 4);
  const double phi = 12.0 * 2.66 / 16.0 / 9.0 / 0.89;
  const double shear_N = 6.0 / (1.0 + phi) * EI_N_m2 / std::pow(120e-6, 2) * 50e-6 / curvature_m;
  // Row 1 lies at y < 0, column 2 at x > 0; tops are deepest on the side of the middle.
  CHECK(on_top(answer, "shear_force_x", 1, 2) == Approx(shear_N).epsilon(0.05));
  CHECK(on_top(answer, "shear_force_x", 1, 1) ==
        Approx(-on_top(answer, "shear_force_x", 1, 2)).epsilon(1e-8));
  CHECK(on_top(answer, "shear_force_y", 1, 2) ==
        Approx(-on_top(answer, "shear_force_x", 1, 2)).epsilon(1e-8));
  CHECK(on_top(answer, "moment_x", 1, 2) < 0.0);
  CHECK(std::any_of(answer.notes.begin(), answer.notes.end(), [](const std::string& note) {
    return note.find("full stick") != std::string::npos;
  }));
  // Under a force, the depth is found again.
  SpaceScene pushed = sticking_array(2, 2, paraboloid(curvature_m), 0.0);
  pushed.press->force_N = result_of(answer, "contact_force");
  CHECK(result_of(simulate(pushed), "depth") == Approx(10e-6).epsilon(1e-10));
}

TEST_CASE("a plane presses tops that stick without shear", "[models][array][space]") {
  const SceneAnswer answer = simulate(sticking_array(1, 2, plane(), 1e-6));
  CHECK(on_top(answer, "pillar_force", 1, 1) == Approx(19.255e-6).epsilon(1e-3));
  CHECK(std::abs(on_top(answer, "shear_force_x", 1, 1)) < 1e-15);
  CHECK(on_top(answer, "contact_share_percent", 1, 2) == 100.0);
  SpaceScene free_tops = sticking_array(1, 2, plane(), 1e-6);
  free_tops.press->friction = Friction::kNone;
  for (const SceneResult& one : simulate(free_tops).results) {
    CHECK_FALSE(one.name.starts_with("shear_force"));
  }
}

TEST_CASE("tops touched in part that stick are answered within their errors",
          "[models][array][space][stability]") {
  SpaceScene scene = sticking_array(2, 2, paraboloid(500e-6), 4e-6);
  scene.press->shape.x_m = 7e-6;
  scene.press->shape.y_m = -4e-6;
  scene.tolerance = 3e-2;
  const SceneAnswer coarse = simulate(scene);
  scene.tolerance = 5e-3;
  const SceneAnswer fine = simulate(scene);
  for (std::size_t m = 0; m < coarse.maps.size(); ++m) {
    const SceneMap& map = coarse.maps[m];
    CAPTURE(map.name);
    for (std::size_t i = 0; i < map.value.size(); ++i) {
      CHECK(std::abs(map.value[i] - fine.maps[m].value[i]) <=
            map.error[i] + fine.maps[m].error[i] + 1e-4 * size_of(map));
    }
  }
}

TEST_CASE("friction of tops is refused where it is not answered", "[models][array][space]") {
  SpaceScene on_backing = sticking_array(2, 2, plane(), 1e-6);
  on_backing.backing = Backing{1e9, 0.3};
  CHECK_THAT(friction_refusal(on_backing),
             Catch::Contains("shape.friction: sticks") && Catch::Contains("on a backing"));
  SpaceScene held = sticking_array(2, 2, plane(), 1e-6);
  held.press->work_of_adhesion_J_m2 = 0.04;
  CHECK_THAT(friction_refusal(held), Catch::Contains("beside adhesion"));
  SpaceScene in_time = touched(2, 2, plane(), false, {{0.0, 0.0}, {1.0, 1e-6}});
  in_time.press->friction = Friction::kStick;
  CHECK_THAT(friction_refusal(in_time), Catch::Contains("in time"));
}
