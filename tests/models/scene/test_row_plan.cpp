#include "models/answer/scene_mistake.h"
#include "models/array/plane/row_contact.h"
#include "models/array/plane/simulate_array.h"
#include "models/scene/plan.h"
#include "models/scene/simulate.h"
#include "tests/models/array/plane/pressed_rows.h"
#include "tests/models/array/plane/seed_array.h"
#include "tests/models/scene/random_rows.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>
#include <sstream>

using namespace viscard;
using namespace viscard::test;

namespace {

const SceneEffect& effect_of(const ScenePlan& plan, const std::string& name) {
  const auto found = std::find_if(plan.effects.begin(), plan.effects.end(),
                                  [&](const SceneEffect& e) { return e.name == name; });
  if (found == plan.effects.end()) throw std::runtime_error("no effect " + name);
  return *found;
}

// Largest error of the wanted results over the tolerance, and whether every estimate covers it.
struct Verdict {
  double over = 0.0;
  bool is_honest = true;
};

Verdict verdict_on(const ArrayScene& scene, int fine_degree) {
  const SceneAnswer planned = simulate(scene);
  const auto all = std::get<ArrayScene>(plan_effects(with_all_effects_on(scene)).reduced);
  const SceneAnswer fine =
      array_answer_on(all, {.degree = fine_degree,
                            .layers = fine_degree / 2 + (scene.electrodes.is_equipotential ? 3 : 0),
                            .shaft_elements = 2});
  Verdict verdict;
  double largest = 0.0, estimate = 0.0;
  const auto judge = [&](double mine, double exact, double size, double allowed) {
    const double error = std::abs(mine - exact);
    largest = std::max(largest, error / size);
    estimate = std::max(estimate, allowed / size);
    verdict.is_honest = verdict.is_honest && error <= allowed + 0.02 * scene.tolerance * size;
  };
  for (const SceneResult& mine : planned.results) {
    if (!mine.is_wanted) continue;
    for (const SceneResult& exact : fine.results) {
      if (exact.name != mine.name) continue;
      judge(mine.value, exact.value, std::max(std::abs(exact.value), exact.scale),
            mine.error_estimate);
    }
  }
  REQUIRE(planned.modes.size() == fine.modes.size());
  for (std::size_t i = 0; i < fine.modes.size(); ++i) {
    judge(planned.modes[i].frequency_Hz, fine.modes[i].frequency_Hz, fine.modes[i].frequency_Hz,
          planned.modes[i].error_estimate);
  }
  verdict.over = largest / scene.tolerance;
  verdict.is_honest =
      verdict.is_honest && estimate <= std::max(20.0 * largest, scene.tolerance) * (1.0 + 1e-9);
  return verdict;
}

void study(int count, unsigned long seed, int fine_degree = 8) {
  std::mt19937_64 random(seed);
  int answered = 0, below = 0, honest = 0;
  double worst = 0.0;
  std::ostringstream doubtful;
  for (int i = 0; i < count; ++i) {
    const ArrayScene scene = random_row(random);
    Verdict v;
    try {
      v = verdict_on(scene, fine_degree);
    } catch (const std::runtime_error& refusal) {  // no wrong answer; they are counted
      doubtful << "\n  scene " << i << " refused: " << refusal.what();
      continue;
    }
    ++answered;
    below += v.over <= 1.0 ? 1 : 0;
    honest += v.is_honest ? 1 : 0;
    worst = std::max(worst, v.over);
    if (v.over <= 1.0 && v.is_honest) continue;
    const ArrayGeometry& g = scene.geometry;
    doubtful << "\n  scene " << i << " tol " << scene.tolerance << " kind " << scene.drive.index()
             << " d/t " << g.diameter_m / g.film_thickness_m << " s/t "
             << g.spacing_m / g.film_thickness_m << " over " << v.over << " "
             << (scene.wanted.empty() ? "modes" : scene.wanted.front());
  }
  WARN(below << " of " << answered << " answered of " << count
             << " rows below their tolerance (worst " << worst << " of it), " << honest << " honest"
             << doubtful.str());
  // Soft films vibrate themselves, per cents of a voltage that is zero have no meaning: seed 7 has
  // six refusals in a hundred.
  CHECK(answered >= std::lround(0.9 * count));
  CHECK(below >= std::lround(0.99 * answered));
  CHECK(worst <= 2.0);
  CHECK(honest >= std::lround(0.95 * answered));
}

}  // namespace

TEST_CASE("neighbours are not left out if shear is read", "[array][plan]") {
  ArrayScene scene = seed_scene();
  scene.geometry.spacing_m = 400e-6;
  scene.geometry.film_edge_m = 400e-6;
  scene.wanted = {"centre_voltage"};
  scene.loaded = {1};
  scene.load = ArrayLoad::kShear;
  const SceneEffect crosstalk = effect_of(plan_effects(scene), "crosstalk");
  CHECK(crosstalk.on);
  CHECK(crosstalk.reason.find("sheared alone") != std::string::npos);
  scene.load = ArrayLoad::kPressure;
  CHECK_FALSE(effect_of(plan_effects(scene), "crosstalk").on);
}

TEST_CASE("neighbours too far to matter are left out and then cost nothing", "[array][plan]") {
  ArrayScene scene = seed_scene();
  scene.wanted = {"centre_voltage"};
  scene.tolerance = 1e-2;
  scene.geometry.spacing_m = 60e-6;
  CHECK(effect_of(plan_effects(scene), "crosstalk").on);
  scene.geometry.spacing_m = 200e-6;
  scene.geometry.film_edge_m = 200e-6;
  const ScenePlan far = plan_effects(scene);
  CHECK_FALSE(effect_of(far, "crosstalk").on);
  const SceneAnswer planned = simulate(scene);
  scene.effects["crosstalk"] = EffectChoice::kOn;
  const SceneAnswer all = simulate(scene);
  CHECK(planned.unknowns < all.unknowns);
  const auto is_centre = [](const SceneResult& r) { return r.name.starts_with("centre_voltage"); };
  CHECK(std::count_if(planned.results.begin(), planned.results.end(), is_centre) == 8);
  scene.effects = {};
  scene.wanted = {"centre_voltage", "neighbours_percent"};
  CHECK(effect_of(plan_effects(scene), "crosstalk").on);  // asked for
}

TEST_CASE("the cross-talk estimate covers the cross-talk of rows on the thesis' film",
          "[array][plan]") {
  const double diameter_t = GENERATE(0.4, 1.6, 6.4);
  const double spacing_t = GENERATE(0.5, 1.5, 3.0, 5.0);
  const PlaneState plane = GENERATE(PlaneState::kStress, PlaneState::kStrain);
  CAPTURE(diameter_t, spacing_t, static_cast<int>(plane));
  ArrayScene scene = seed_scene();
  scene.plane = plane;
  scene.wanted = {"mean_voltage"};
  scene.geometry = endless_row(spacing_t * 25e-6, 25e-6, diameter_t * 25e-6);
  const double estimate = effect_of(plan_effects(scene), "crosstalk").estimate;
  const double near = seed_response(scene.geometry, plane).mean_V(0, 0);
  scene.geometry.spacing_m = 15.0 * std::max(scene.geometry.diameter_m, 40e-6);
  const double alone = seed_response(scene.geometry, plane).mean_V(0, 0);
  CHECK(std::min(1.0, std::abs(near / alone - 1.0)) <= estimate);
}

TEST_CASE("modes and deflections of a row need its film only at tight tolerances",
          "[array][plan]") {
  ArrayScene scene = seed_scene();
  scene.drive = RowModal{.modes = 1};
  scene.tolerance = 1e-2;
  CHECK_FALSE(effect_of(plan_effects(scene), "film_compliance").on);
  CHECK(simulate(scene).modes.size() == 16);
  scene.tolerance = 1e-5;
  CHECK(effect_of(plan_effects(scene), "film_compliance").on);
  scene.effects["film_compliance"] = EffectChoice::kOff;
  CHECK_FALSE(effect_of(plan_effects(scene), "film_compliance").on);
  scene.effects = {{"finite_strain", EffectChoice::kOn}};
  scene.drive = RowStatic{};
  CHECK_THROWS_AS(plan_effects(scene), SceneMistake);
}

TEST_CASE("modes of a row are refused with the reason if the film would vibrate too",
          "[array][plan]") {
  ArrayScene scene = seed_scene();
  scene.drive = RowModal{.modes = 2};
  scene.geometry.count = 2;
  scene.geometry.film_thickness_m = 60e-6;
  scene.film = isotropic_medium(10.0 * scene.pillar.E0_Pa, 0.3, 8000.0);
  CHECK_THROWS_WITH(simulate(scene), Catch::Contains("film's own inertia"));
  scene.film.rho_kg_m3 = 1.0;
  CHECK_NOTHROW(simulate(scene));
}

TEST_CASE("oscillations of a row are refused with the reason if the film would vibrate too",
          "[array][plan]") {
  ArrayScene scene = seed_scene();
  scene.geometry.count = 2;
  scene.geometry.film_thickness_m = 60e-6;
  scene.film = isotropic_medium(10.0 * scene.pillar.E0_Pa, 0.3, 8000.0);
  scene.drive = RowHarmonic{{1e5}};
  CHECK_THROWS_WITH(simulate(scene), Catch::Contains("film's own inertia"));
}

TEST_CASE("pillars long enough to stick to their neighbours are reported", "[array][plan]") {
  ArrayScene scene = seed_scene();
  scene.geometry.diameter_m = 10e-6;
  scene.geometry.spacing_m = 10e-6;
  scene.geometry.length_m = 30e-6;
  CHECK(effect_of(plan_effects(scene), "adhesion").estimate == 0.0);
  scene.geometry.length_m = 100e-6;
  scene.load_Pa = 100.0;
  const SceneEffect adhesion = effect_of(plan_effects(scene), "adhesion");
  CHECK(adhesion.value > 1.0);
  CHECK(adhesion.reason.find("lateral collapse") != std::string::npos);
}

TEST_CASE("a narrow cylinder lifts a strip that it overlaps everywhere", "[array][plan]") {
  ArrayScene scene = pressed_row(cylinder(0.5e-6, Friction::kNone, 0.5e-3), 1);
  scene.tolerance = 1e-2;
  const double force_N_m = row_contact_on(scene, kRowGrids - 1).force_N_m;
  ArrayScene follows = scene;
  follows.feels_contact = false;
  CHECK(row_contact_on(follows, kRowGrids - 1).force_N_m < 0.95 * force_N_m);
  const SceneAnswer answer = simulate(scene);
  const auto force = std::find_if(answer.results.begin(), answer.results.end(),
                                  [](const SceneResult& r) { return r.name == "contact_force"; });
  REQUIRE(force != answer.results.end());
  CHECK(force->value == Approx(force_N_m).epsilon(scene.tolerance));
}

TEST_CASE("random rows are answered within their tolerance by their plans", "[array][plan]") {
  study(12, 20140611, 7);
}

TEST_CASE("a hundred random rows are answered within their tolerance", "[array][plan][slow]") {
  study(100, 7);
}

// VISCARD_SEED=n tries another seed.
TEST_CASE("another seed of rows is answered within its tolerance", "[.][heldout]") {
  const char* seed = std::getenv("VISCARD_SEED");
  study(100, seed != nullptr ? std::strtoul(seed, nullptr, 10) : 1);
}
