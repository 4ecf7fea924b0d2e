// Adhesion of a shape to the tops of pillars, as scenes of arrays in the plane and of rows.
#include "models/array/space/space_contact.h"
#include "models/scene/plan.h"
#include "models/scene/simulate.h"
#include "tests/models/array/plane/pressed_rows.h"
#include "tests/models/scene/touches.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace viscard;
using namespace viscard::test;

namespace {

constexpr double kStiffness_N_m = 19.0468;  // of a pillar on the thesis' film, a graded mesh

SpaceScene adhesive(int rows, int columns, double radius_m, double depth_m,
                    std::vector<double> before_m, double work_J_m2 = 0.04) {
  SpaceScene scene = touched(rows, columns, paraboloid(radius_m), false, {{0.0, 0.0}, {1.0, 1e-6}});
  scene.pillar.terms.clear();
  scene.touch.reset();
  scene.press->depth_m = depth_m;
  scene.press->work_of_adhesion_J_m2 = work_J_m2;
  scene.press->before_m = std::move(before_m);
  return scene;
}

double force_at(const SceneAnswer& answer, const std::string& name, std::size_t pillar) {
  for (const SceneMap& map : answer.maps) {
    if (map.name != name) continue;
    for (std::size_t i = 0; i < map.pillar.size(); ++i) {
      if (map.pillar[i] == pillar) return map.value[i];
    }
  }
  throw std::runtime_error("no value of " + name);
}

bool is_noted(const SceneAnswer& answer, const std::string& part) {
  return std::any_of(answer.notes.begin(), answer.notes.end(),
                     [&](const std::string& note) { return note.find(part) != std::string::npos; });
}

}  // namespace

TEST_CASE("a round top holds 127.46 uN at 0.04 J/m2 and lets go at a stretch of 6.692 um",
          "[models][array][space]") {
  const double radius_m = 1.0;  // nearly flat
  const SceneAnswer held = simulate(adhesive(1, 1, radius_m, -6.68e-6, {1e-6}));
  const double force_N = force_at(held, "pillar_force", 0);
  CHECK(force_N == Approx(-kStiffness_N_m * (6.68e-6 + 1e-10)).epsilon(1e-4));
  CHECK(-force_N / (std::numbers::pi * 4e-10) < 101.43e3);
  const double release_m = force_at(held, "release_depth", 0);
  // The mean of the paraboloid over the top is R^2/(4 radius).
  CHECK(-release_m + 1e-10 == Approx(6.692e-6).epsilon(1e-4));
  CHECK(kStiffness_N_m * (-release_m + 1e-10) == Approx(127.46e-6).epsilon(1e-4));
  CHECK(kStiffness_N_m * (-release_m + 1e-10) / (std::numbers::pi * 4e-10) ==
        Approx(101.43e3).epsilon(1e-4));
  const SceneAnswer gone = simulate(adhesive(1, 1, radius_m, -6.70e-6, {1e-6}));
  CHECK(force_at(gone, "pillar_force", 0) == 0.0);
  CHECK(is_noted(gone, "1 have let go"));
}

TEST_CASE("approach and retreat of an adhesive shape differ until all tops have let go",
          "[models][array][space]") {
  const auto force_N = [](double depth_m, const std::vector<double>& before_m) {
    const SceneAnswer answer = simulate(adhesive(3, 3, 20e-3, depth_m, before_m));
    return test::result_of(answer, "contact_force");
  };
  // On the way down nothing is touched above the tops; on the way back all nine are pulled.
  const double back_N = force_N(-2e-6, {2e-6});
  double expected_N = 0.0;
  for (const double r2 : {0.0, 1e-8, 1e-8, 1e-8, 1e-8, 2e-8, 2e-8, 2e-8, 2e-8}) {
    expected_N += kStiffness_N_m * (-2e-6 - (r2 + 2e-10) / 40e-3);
  }
  CHECK(back_N == Approx(expected_N).epsilon(1e-4));
  // The corners, 0.5 um above the middle, let go first.
  const SceneAnswer some = simulate(adhesive(3, 3, 20e-3, -6.5e-6, {2e-6}));
  CHECK(force_at(some, "pillar_force", 0) == 0.0);
  CHECK(force_at(some, "pillar_force", 4) < 0.0);
  CHECK(is_noted(some, "8 have let go"));
  CHECK(test::result_of(simulate(adhesive(3, 3, 20e-3, -7e-6, {2e-6})), "contact_force") == 0.0);
  // In contact everywhere adhesion changes nothing.
  CHECK(force_N(2e-6, {}) ==
        Approx(test::result_of(simulate(adhesive(3, 3, 20e-3, 2e-6, {}, 0.0)), "contact_force"))
            .epsilon(1e-6));
}

TEST_CASE("the outer pillars of chapter 8 would just not hold", "[models][array][space]") {
  // The thesis pulls them by 6.820 um, 103.4 kPa; at 0.04 J/m2 (two surfaces of PDMS) tops let go at
  // 101.43 kPa.
  SpaceScene scene = adhesive(1, 8, 3650e-6, 10e-6, {}, 0.0);
  scene.press->shape.kind = ShapeKind::kCylinder;
  scene.effects["contact"] = EffectChoice::kOff;
  const SceneAnswer followed = simulate(scene);
  CHECK(force_at(followed, "pillar_force", 7) == Approx(-130.156e-6).epsilon(1e-3));
  CHECK(is_noted(followed, "beyond pull-off"));
  scene.effects.clear();
  scene.press->work_of_adhesion_J_m2 = 0.04;
  const SceneAnswer held = simulate(scene);
  CHECK(force_at(held, "pillar_force", 7) == 0.0);
  // The top beside, which lifts without adhesion, lies flat with it.
  CHECK(force_at(held, "contact_share_percent", 6) == 100.0);
  CHECK_FALSE(is_noted(held, "beyond pull-off"));
}

TEST_CASE("the plan leaves pull-off out where it cannot matter", "[models][array][plan]") {
  const auto pull_off = [](const Scene& scene) {
    const std::vector<SceneEffect> effects = plan_effects(scene).effects;
    const auto found = std::find_if(effects.begin(), effects.end(),
                                    [](const SceneEffect& one) { return one.name == "pull_off"; });
    REQUIRE(found != effects.end());
    return *found;
  };
  CHECK_FALSE(pull_off(adhesive(1, 1, 1.0, 3e-6, {}, 0.0)).on);
  CHECK(pull_off(adhesive(1, 1, 1.0, 3e-6, {})).on);
  CHECK_FALSE(pull_off(adhesive(1, 1, 1.0, 3e-6, {}, 1e-12)).on);
  CHECK(pull_off(adhesive(1, 1, 1.0, 1e-6, {3e-6}, 1e-12)).on);
  ArrayScene row = pressed_row(cylinder(3e-6));
  CHECK_FALSE(pull_off(row).on);
  row.press->work_of_adhesion_J_m2 = 0.04;
  CHECK(pull_off(row).on);
  CHECK(pull_off(row).value ==
        Approx(std::sqrt(std::numbers::pi * 1.8e6 * 0.04 * 40e-6) / (1.8e6 * 40e-6 * 3e-6 / 120e-6))
            .epsilon(0.2));
}

TEST_CASE("tops that adhere are pulled at the depth 0 of the shape", "[models][array]") {
  ArrayScene row = pressed_row(cylinder(0.0, Friction::kNone, 20e-3));
  row.press->work_of_adhesion_J_m2 = 0.02;
  row.press->before_m = {5e-6};
  row.tolerance = 2e-2;
  const auto force_N_m = [&](double depth_m) {
    row.press->depth_m = depth_m;
    return test::result_of(simulate(row), "contact_force");
  };
  const double force = force_N_m(0.0);
  CHECK(force < 0.0);
  // Held tops follow the shape: the force is linear in the depth.
  CHECK(force == Approx(0.5 * (force_N_m(-0.1e-6) + force_N_m(0.1e-6))).epsilon(1e-6));
}

TEST_CASE("the stretch of pulled tops counts as strain", "[models][array][plan]") {
  const auto strain = [](const Scene& scene) {
    const std::vector<SceneEffect> effects = plan_effects(scene).effects;
    return std::find_if(effects.begin(), effects.end(),
                        [](const SceneEffect& one) { return one.name == "finite_strain"; })
        ->value;
  };
  // The film and a nearly flat shape aside, a pillar of 120 um is stretched by 2.5 um.
  ArrayScene row = pressed_row(cylinder(-2.5e-6, Friction::kNone, 10.0));
  row.press->work_of_adhesion_J_m2 = 0.02;
  row.press->before_m = {5e-6};
  row.wanted = {"contact_force"};
  CHECK(strain(row) == Approx(2.5 / 120.0).epsilon(1e-2));
  // Where it lets go the mean pull is sqrt(pi E w/d).
  row.wanted = {"release_depth"};
  const double limit_Pa = std::sqrt(std::numbers::pi * 1.8e6 * 0.02 / 40e-6);
  CHECK(strain(row) == Approx(limit_Pa / 1.8e6).epsilon(1e-6));
  row.wanted = {"contact_force"};
  row.press->depth_m = -20e-6;
  CHECK(strain(row) == Approx(limit_Pa / 1.8e6).epsilon(1e-6));
  // A top that was never touched is not pulled.
  row.press->before_m = {-1e-6};
  CHECK(strain(row) == 0.0);

  SpaceScene array = adhesive(3, 3, 10.0, -2.5e-6, {2e-6});
  array.wanted = {"contact_force"};
  CHECK(strain(array) == Approx(2.5e-6 / array.length_m).epsilon(1e-2));
}
