// Arrays in the plane under a rigid shape, as scenes: forces, voltages, plan and notes.
#include "models/answer/scene_mistake.h"
#include "models/array/space/foot_motion.h"
#include "models/array/space/simulate_space.h"
#include "models/array/space/space_contact.h"
#include "models/array/space/touch_steps.h"
#include "models/scene/plan.h"
#include "models/scene/simulate.h"
#include "tests/models/array/space/film_of_the_thesis.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace viscard;
using namespace viscard::test;

namespace {

SpaceScene pressed_array(int rows, int columns, const ShapePress& press) {
  SpaceScene scene;
  scene.pillar.E0_Pa = 1.8e6;
  scene.pillar.nu = 0.33;
  scene.pillar.rho_kg_m3 = 965.0;
  scene.film = pvdf_of_the_thesis();
  scene.rows = rows;
  scene.columns = columns;
  scene.pillars = lattice_places(SpaceLattice::kSquare, rows, columns, 100e-6);
  scene.film_edge_m = 300e-6;
  scene.tolerance = 5e-3;
  scene.press = press;
  return scene;
}

ShapePress paraboloid(double radius_m, double depth_m) {
  return {.shape = {.kind = ShapeKind::kParaboloid, .radius_m = radius_m}, .depth_m = depth_m};
}

double value_at(const SceneAnswer& answer, const std::string& name, int row, int column) {
  for (const SceneMap& map : answer.maps) {
    if (map.name != name) continue;
    for (std::size_t at = 0; at < map.value.size(); ++at) {
      const ScenePillar& one = answer.array.pillars[map.pillar[at]];
      if (one.row == row && one.column == column) return map.value[at];
    }
  }
  throw std::runtime_error("no value of " + name);
}

const SceneResult& result_of(const SceneAnswer& answer, const std::string& name) {
  const auto found = std::find_if(answer.results.begin(), answer.results.end(),
                                  [&](const SceneResult& one) { return one.name == name; });
  if (found == answer.results.end()) throw std::runtime_error("no result " + name);
  return *found;
}

bool has_note(const SceneAnswer& answer, const std::string& part) {
  return std::any_of(answer.notes.begin(), answer.notes.end(),
                     [&](const std::string& note) { return note.find(part) != std::string::npos; });
}

}  // namespace

TEST_CASE("a tip between the points of a top is refused, not missed",
          "[models][array][space][stability]") {
  ShapePress press{.shape = {.kind = ShapeKind::kTable}, .depth_m = 1e-6};
  const auto refused = [&](double half_width_m) {
    HeightTable& table = press.shape.table;
    table.x_m = table.y_m = {-200e-6, -half_width_m, 0.0, half_width_m, 200e-6};
    table.height_m.assign(25, 2e-6);
    table.height_m[12] = 0.0;
    try {
      simulate(pressed_array(1, 1, press));
    } catch (const SceneMistake& mistake) {
      return std::string(mistake.key());
    } catch (const std::runtime_error&) {  // partial contact that no grid settles
      return std::string("grid");
    }
    return std::string();
  };
  CHECK(refused(0.05e-6) == "shape.file");
  CHECK(refused(10e-6) != "shape.file");
}

TEST_CASE("pillars under a paraboloid bear and read what the reference does",
          "[models][array][space]") {
  // k (delta - (r^2 + a^2/2)/(2 R)) with k = 19.0468 N/m of a graded mesh on this film.
  const SceneAnswer answer = simulate(pressed_array(8, 8, paraboloid(3650e-6, 10e-6)));
  CHECK(value_at(answer, "pillar_force", 4, 5) == Approx(176.900e-6).epsilon(3e-5));
  CHECK(value_at(answer, "pillar_force", 5, 6) == Approx(124.717e-6).epsilon(3e-5));
  CHECK(value_at(answer, "pillar_force", 3, 6) == Approx(72.534e-6).epsilon(3e-5));
  CHECK(result_of(answer, "contacts").value == 24.0);
  CHECK(result_of(answer, "contact_force").value == Approx(2.158289e-3).epsilon(1e-3));
  CHECK(result_of(answer, "largest_pressure").value ==
        Approx(176.900e-6 / (std::numbers::pi * 4e-10)).epsilon(3e-5));
  // -1.92665 mV per kPa of the own load (an independent program), less -0.26 and 0.19 % for neighbours
  // that bear 70 % of it, and the tilt of the tops, which neighbours read too.
  const double own_V = -1.92665e-6 * result_of(answer, "largest_pressure").value;
  CHECK(value_at(answer, "mean_voltage", 4, 5) == Approx(own_V).epsilon(5e-3));
  // Four times the buckling load of a free top, beyond that of a plate: 29.369 and 99.594 kPa.
  CHECK(has_note(answer, "which is exceeded too"));
  CHECK(has_note(answer, "large strain"));
}

TEST_CASE("a plane that is level is a uniform load", "[models][array][space]") {
  SpaceScene by_shape =
      pressed_array(4, 4, {.shape = {.kind = ShapeKind::kPlane}, .depth_m = 1e-6});
  const SceneAnswer pressed = simulate(by_shape);
  const double pressure_Pa = result_of(pressed, "largest_pressure").value;
  CHECK(pressure_Pa == Approx(1e-6 / 6.59763e-11).epsilon(2e-5));
  SpaceScene by_load = by_shape;
  by_load.press.reset();
  by_load.pressure_Pa = pressure_Pa;
  const SceneAnswer loaded = simulate(by_load);
  for (const auto& [row, column] : {std::pair{1, 1}, {2, 3}, {4, 4}}) {
    CHECK(value_at(pressed, "centre_voltage", row, column) ==
          Approx(value_at(loaded, "centre_voltage", row, column)).epsilon(1e-4));
  }
  // It covers all tops, so that nothing has to be held back from pulling.
  const auto contact = std::find_if(pressed.effects.begin(), pressed.effects.end(),
                                    [](const SceneEffect& one) { return one.name == "contact"; });
  CHECK_FALSE(contact->on);
  CHECK(contact->estimate == 0.0);
}

TEST_CASE("a shape with a force reaches the depth that gives it", "[models][array][space]") {
  ShapePress press = paraboloid(2e-3, 3e-6);
  const SceneAnswer by_depth = simulate(pressed_array(5, 5, press));
  press.force_N = result_of(by_depth, "contact_force").value;
  press.depth_m = 0.0;
  const SceneAnswer by_force = simulate(pressed_array(5, 5, press));
  CHECK(result_of(by_force, "depth").value == Approx(3e-6).epsilon(1e-9));
  CHECK(result_of(by_force, "contact_force").value == Approx(press.force_N).epsilon(1e-10));
  CHECK(result_of(by_force, "depth").error_estimate > 0.0);
}

TEST_CASE("a shape that is prescribed pulls where it does not touch", "[models][array][space]") {
  SpaceScene scene = pressed_array(8, 8, paraboloid(3650e-6, 10e-6));
  scene.effects["contact"] = EffectChoice::kOff;
  const SceneAnswer answer = simulate(scene);
  const double r2_m2 = 2.0 * 350e-6 * 350e-6;
  const double overlap_m = 10e-6 - (r2_m2 + 2e-10) / (2.0 * 3650e-6);
  CHECK(value_at(answer, "pillar_force", 1, 1) == Approx(19.0468 * overlap_m).epsilon(3e-5));
  CHECK(value_at(answer, "mean_voltage", 1, 1) > 0.0);
  // Another task, and no error of this one: the outer pillars are right to what is stated, and a note names the other.
  CHECK(has_note(answer, "prescribes the motion"));
  CHECK(answer.within_tolerance);
  for (const SceneMap& map : answer.maps) {
    if (map.name != "pillar_force") continue;
    CHECK(*std::max_element(map.error.begin(), map.error.end()) < 0.01 * size_of(map));
  }
}

// The surface reaches below every point of the top, which yet lifts around the middle: its mean overlap would bear a fifth less.
TEST_CASE("a narrow shape lifts a top that it overlaps everywhere", "[models][array][space]") {
  ShapePress ridge{.shape = {.kind = ShapeKind::kWedge, .slope = 0.01}, .depth_m = 0.5e-6};
  for (const ShapePress& press : {paraboloid(0.5e-3, 0.5e-6), ridge}) {
    const SpaceScene scene = pressed_array(1, 1, press);
    const double force_N = contact_on(scene, 3).pressed.force_N;
    SpaceScene follows = scene;
    follows.feels_contact = false;
    CHECK(contact_on(follows, 3).pressed.force_N < 0.99 * force_N);
    const SceneAnswer answer = simulate(scene);
    CHECK(result_of(answer, "contact_force").value == Approx(force_N).epsilon(scene.tolerance));
    CHECK(value_at(answer, "contact_share_percent", 1, 1) < 90.0);
  }
}

TEST_CASE("the errors of a pressed array hold", "[models][array][space][stability]") {
  for (const double radius_m : {120e-6, 400e-6}) {
    SpaceScene scene = pressed_array(3, 3, paraboloid(radius_m, 2e-6));
    scene.press->shape.x_m = 13e-6;
    scene.press->shape.y_m = -7e-6;
    scene.tolerance = 2e-2;
    const SceneAnswer answer = simulate(scene);
    scene.tolerance = 2e-3;
    const SceneAnswer finer = simulate(scene);
    INFO("radius " << radius_m);
    for (std::size_t m = 0; m < answer.maps.size(); ++m) {
      INFO(answer.maps[m].name);
      for (std::size_t at = 0; at < answer.maps[m].value.size(); ++at) {
        CHECK(std::abs(answer.maps[m].value[at] - finer.maps[m].value[at]) <=
              answer.maps[m].error[at] + finer.maps[m].error[at] +
                  1e-12 * std::abs(finer.maps[m].value[at]));
      }
    }
  }
}

TEST_CASE("extremes of a pressed array are answered or refused",
          "[models][array][space][stability]") {
  SECTION("one pillar, a nanometre deep") {
    const SpaceScene scene = pressed_array(1, 1, paraboloid(1.0, 1e-9));
    const double force_N = result_of(simulate(scene), "contact_force").value;
    // The rim, a fifth less deep than the middle, lifts: a little more than the mean overlap bears.
    CHECK(force_N > 19.0468 * (1e-9 - 1e-10));
    CHECK(force_N < 1.01 * 19.0468 * (1e-9 - 1e-10));
    CHECK(force_N == Approx(contact_on(scene, 3).pressed.force_N).epsilon(scene.tolerance));
  }
  SECTION("a shape beside the array") {
    ShapePress press = paraboloid(1e-3, 1e-6);
    press.shape.x_m = 5e-3;
    const SceneAnswer answer = simulate(pressed_array(2, 2, press));
    CHECK(result_of(answer, "contact_force").value == 0.0);
    CHECK(has_note(answer, "touches no pillar"));
  }
  SECTION("neither depth nor force, both, or a load beside the shape") {
    CHECK_THROWS_AS(simulate(pressed_array(2, 2, paraboloid(1e-3, 0.0))), SceneMistake);
    ShapePress both = paraboloid(1e-3, 1e-6);
    both.force_N = 1e-3;
    CHECK_THROWS_AS(simulate(pressed_array(2, 2, both)), SceneMistake);
    SpaceScene loaded = pressed_array(2, 2, paraboloid(1e-3, 1e-6));
    loaded.pressure_Pa = 1e3;
    CHECK_THROWS_AS(simulate(loaded), SceneMistake);
  }
  SECTION("deeper than the pillars are long, or a force that would flatten them") {
    CHECK_THROWS_AS(simulate(pressed_array(2, 2, paraboloid(1e-3, 1e-3))), SceneMistake);
    ShapePress press = paraboloid(1e-3, 0.0);
    press.force_N = 1.0;
    CHECK_THROWS_AS(simulate(pressed_array(2, 2, press)), SceneMistake);
  }
  SECTION("an edge cannot be followed by tops beside it") {
    SpaceScene scene = pressed_array(2, 2, {.shape = {.kind = ShapeKind::kEdge}, .depth_m = 1e-6});
    scene.effects["contact"] = EffectChoice::kOff;
    CHECK_THROWS_AS(simulate(scene), SceneMistake);
  }
  SECTION("a tolerance that the finest grid does not meet") {
    // An edge over the middle of tops: their error falls as the size of the elements.
    SpaceScene scene = pressed_array(1, 1, {.shape = {.kind = ShapeKind::kEdge}, .depth_m = 1e-6});
    scene.tolerance = 2e-3;
    CHECK_THROWS_AS(simulate(scene), std::runtime_error);
    scene.tolerance = 1e-2;
    CHECK(simulate(scene).largest_relative_error < 1e-2);
  }
}

TEST_CASE("a foot settles into its film by a ten-thousandth of the pillar's shortening",
          "[models][array][space]") {
  const SpaceScene scene = pressed_array(1, 1, paraboloid(1.0, 1e-6));
  const SpaceArray array = array_of(scene);
  const FootForces foot =
      foot_forces(array.classes[0].geometry, array.classes[0].medium, {.degree = 6, .layers = 3});
  // One p-element mesh of pillar and film (viscard's own pillar solver): 6.59763e-11 m/Pa in all, and
  // 6.59692e-11 on a rigid base; another program's Fourier integral of the foot alone: 6.92e-15.
  CHECK(foot_settling_m_Pa(array.film, foot) == Approx(6.97e-15).epsilon(0.02));
  CHECK(foot.sinking_m_Pa == Approx(6.59692e-11).epsilon(1e-5));
}

TEST_CASE("an answer on one mesh has every result of the answer", "[models][array][space]") {
  const auto missing_in = [](const SpaceScene& scene) {
    const SceneAnswer whole = simulate(scene);
    const SceneAnswer one = answer_on(plan_effects(scene).reduced, whole.discretisation);
    std::string missing;
    for (const SceneResult& result : whole.results) {
      const bool is_there =
          std::any_of(one.results.begin(), one.results.end(),
                      [&](const SceneResult& other) { return other.name == result.name; });
      if (!is_there) missing += result.name + " ";
    }
    return missing;
  };
  SpaceScene scene = pressed_array(3, 3, paraboloid(20e-3, 2e-6));
  CHECK(missing_in(scene) == "");
  scene.wanted = {"mean_voltage_2_2", "pillar_force", "pillar_force_2_2", "contact_force"};
  CHECK(missing_in(scene) == "");
  scene.wanted.clear();
  scene.pillar.terms = {{0.3, 0.3, 0.2}};
  press_in_time(scene, {.is_creep = false, .history = {{0.0, 0.0}, {1.0, 2e-6}}, .readout = {}});
  CHECK(missing_in(scene) == "");
}

TEST_CASE("moments that vanish by symmetry lie within their error", "[models][array][space]") {
  ShapePress plane;
  plane.shape.kind = ShapeKind::kPlane;
  plane.depth_m = 1e-6;
  const SceneAnswer answer = simulate(pressed_array(3, 3, plane));
  int maps = 0;
  for (const SceneMap& map : answer.maps) {
    if (!map.name.starts_with("moment_")) continue;
    ++maps;
    for (std::size_t i = 0; i < map.value.size(); ++i) {
      INFO(map.name << " " << map.value[i] << " +- " << map.error[i]);
      CHECK(std::abs(map.value[i]) <= map.error[i]);
      CHECK(map.error[i] <= 1e-9 * size_of(map));
    }
  }
  CHECK(maps == 2);
}
