// A load between the long-term and the instantaneous buckling pressure.
#include "models/pillar/analyses/creep_buckling.h"
#include "models/scene/plan.h"
#include "models/scene/simulate.h"
#include "tests/models/pillar/drive_as.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

using namespace viscard;

namespace {

constexpr double kCritical_Pa = 29368.9;  // of the elastic pillar, converged (FreeFEM, CalculiX)
constexpr double kTau_s = 3.0;

// Its modulus falls by half with one time constant: E(t) = E_0 (1 + exp(-t/tau))/2.
PillarScene relaxing_pillar() {
  PillarScene scene;
  scene.pillar.E0_Pa = 1.8e6;
  scene.pillar.nu = 0.33;
  scene.pillar.rho_kg_m3 = 965.0;
  scene.pillar.terms = {{0.5, 0.5, kTau_s}};
  scene.tolerance = 1e-2;
  return scene;
}

// E(t)/E_0 = p/p_cr at constant Poisson ratio without film.
double bears_s(double pressure_Pa) {
  return -kTau_s * std::log(2.0 * pressure_Pa / kCritical_Pa - 1.0);
}

PillarScene creeping(Course history) {
  PillarScene scene = relaxing_pillar();
  scene.drive = CreepDrive{std::move(history)};
  return scene;
}

bool has_note(const SceneAnswer& answer, const std::string& words) {
  return std::any_of(answer.notes.begin(), answer.notes.end(), [&](const std::string& note) {
    return note.find(words) != std::string::npos;
  });
}

}  // namespace

TEST_CASE("a pillar bears a pressure until E(t) has fallen to it", "[pillar][plan]") {
  PillarScene scene = relaxing_pillar();
  const double pressure_Pa = GENERATE(1.6e4, 2e4, 2.8e4);
  scene.drive = StaticDrive{.pressure_Pa = pressure_Pa};
  const auto found = creep_buckling(scene);
  REQUIRE(found);
  CHECK(found->now_Pa == Approx(kCritical_Pa).epsilon(5e-3));  // a coarse mesh
  CHECK(found->long_term_Pa == Approx(0.5 * kCritical_Pa).epsilon(5e-3));
  // 5e-3 of the pressure in terms of time.
  const double spread_s = std::abs(bears_s(1.005 * pressure_Pa) - bears_s(0.995 * pressure_Pa));
  CHECK(std::abs(found->after_s - bears_s(pressure_Pa)) <= spread_s);
  CHECK(found->share == Approx(pressure_Pa / kCritical_Pa).epsilon(5e-3));
}

TEST_CASE("static and modal answers state how long they hold, and buckling the long-term pressure",
          "[pillar][plan]") {
  PillarScene scene = relaxing_pillar();
  scene.drive = StaticDrive{.pressure_Pa = 2e4};
  CHECK(has_note(simulate(scene), "buckles in creep"));
  scene.drive = ModalDrive{.modes = 1, .pressure_Pa = 2e4};
  const SceneAnswer modes = simulate(scene);
  CHECK(has_note(modes, "buckles in creep"));
  CHECK(modes.modes.front().frequency_Hz > 9000.0);  // no mode without a frequency
  scene.drive = ModalDrive{.modes = 1, .pressure_Pa = 1.4e4};
  CHECK_FALSE(has_note(simulate(scene), "buckles in creep"));
  scene.drive = BucklingDrive{};
  CHECK(has_note(simulate(scene), "buckles the pillar in creep from about 1.46"));
  scene.drive = StaticDrive{.pressure_Pa = 2e4};
  scene.effects["geometric_stiffness"] = EffectChoice::kOff;  // it is held straight
  CHECK_FALSE(has_note(simulate(scene), "buckles in creep"));
  scene.pillar.terms.clear();
  scene.effects.clear();
  CHECK_FALSE(has_note(simulate(scene), "buckles in creep"));
}

TEST_CASE("a history of creep is refused from the time at which the pillar buckles",
          "[pillar][plan]") {
  const double p_Pa = 2e4;
  const double t_s = bears_s(p_Pa);
  const auto at_s = [](const PillarScene& scene) { return creep_buckling(scene)->at_s; };
  const PillarScene held = creeping({{0.0, p_Pa}, {2.0 * t_s, p_Pa}});
  CHECK(at_s(held) == Approx(t_s).epsilon(0.03));
  CHECK_THROWS_WITH(simulate(held), Catch::Contains("buckles in creep"));
  CHECK_THROWS_WITH(checked_plan(held), Catch::Contains("buckles in creep"));
  // Later if it begins later.
  CHECK(at_s(creeping({{0.0, 0.0}, {5.0, 0.0}, {5.0, p_Pa}, {20.0, p_Pa}})) ==
        Approx(5.0 + t_s).epsilon(0.03));
  // Under a ramp: the earliest of all levels, here near the top of a slow one, and later than if
  // the largest pressure had acted from the beginning.
  const double ramped_s = at_s(creeping({{0.0, 0.0}, {50.0, p_Pa}, {100.0, p_Pa}}));
  CHECK(ramped_s < 50.0 + t_s);
  CHECK(ramped_s > 0.5 * 50.0 * kCritical_Pa / p_Pa);  // the long-term limit is passed
}

TEST_CASE("a history that ends or unloads before is answered, with a word", "[pillar][plan]") {
  const double t_s = bears_s(2e4);
  const SceneAnswer brief = simulate(creeping({{0.0, 2e4}, {0.5 * t_s, 2e4}}));
  CHECK(has_note(brief, "the history ends or unloads it before"));
  const PillarScene pulses = creeping({{0.0, 2e4},
                                       {0.5 * t_s, 2e4},
                                       {0.5 * t_s, 1e3},
                                       {9.0, 1e3},
                                       {9.0, 2e4},
                                       {9.0 + 0.5 * t_s, 2e4}});
  CHECK(has_note(simulate(pulses), "the history ends or unloads it before"));
  CHECK_FALSE(has_note(simulate(creeping({{0.0, 1.4e4}, {100.0, 1.4e4}})), "in creep"));
  PillarScene straight = creeping({{0.0, 2e4}, {2.0 * t_s, 2e4}});
  straight.effects["geometric_stiffness"] = EffectChoice::kOff;
  CHECK_NOTHROW(simulate(straight));
}

TEST_CASE("a load that swings slowly buckles the pillar in creep within a half cycle",
          "[pillar][plan]") {
  const double p_Pa = 2e4;
  // p cos(w t) stays above L for 2 acos(L/p)/w; the pillar bears L for bears_s(L).
  double below_Hz = 0.0;
  for (double level_Pa = 0.5 * kCritical_Pa + 1.0; level_Pa < p_Pa; level_Pa += 10.0) {
    below_Hz = std::max(below_Hz, std::acos(level_Pa / p_Pa) / (M_PI * bears_s(level_Pa)));
  }
  PillarScene scene = relaxing_pillar();
  const auto swinging = [&](double frequency_Hz, double amplitude_Pa) {
    scene.drive =
        HarmonicDrive{.pressure_Pa = amplitude_Pa, .frequencies_Hz = {frequency_Hz, 100.0}};
    return scene;
  };
  CHECK(creep_buckling(swinging(1.0, p_Pa))->below_Hz == Approx(below_Hz).epsilon(0.03));
  CHECK_THROWS_WITH(simulate(swinging(0.9 * below_Hz, p_Pa)), Catch::Contains("half cycle"));
  CHECK(has_note(simulate(swinging(1.1 * below_Hz, p_Pa)), "the load turns before"));
  CHECK_FALSE(has_note(simulate(swinging(0.9 * below_Hz, 1.4e4)), "in creep"));
  scene.effects["geometric_stiffness"] = EffectChoice::kOff;  // it is held straight
  CHECK_NOTHROW(simulate(swinging(0.9 * below_Hz, p_Pa)));
}

TEST_CASE("a row under a pressure at rest states when its pillars buckle in creep",
          "[array][plan]") {
  ArrayScene row;
  row.pillar = relaxing_pillar().pillar;
  row.film = isotropic_medium(2e9, 0.29, 1780.0);
  row.tolerance = 1e-2;
  row.wanted = {"top_displacement"};
  row.load_Pa = 3e4;  // Engesser's limits of the strip are 38 and 19 kPa
  CHECK(has_note(simulate(row), "buckles in creep"));
  row.load_Pa = 1e4;
  CHECK_FALSE(has_note(simulate(row), "buckles in creep"));
}

TEST_CASE("no answer exceeds its tolerance silently", "[pillar][plan]") {
  SceneAnswer answer;
  answer.modes = {{"lateral", 1, 1e4, 9.0, {}}};
  answer.results = {{"top_displacement", 1e-6, "m", 0.9e-9}};
  require_tolerance(1e-3, answer);
  CHECK(answer.within_tolerance);
  SECTION("in a mode") {
    answer.modes[0].error_estimate = 11.0;
  }
  SECTION("in a result") {
    answer.results[0].error_estimate = 1.1e-9;
  }
  SECTION("in a damping ratio") {
    answer.modes[0].damping_error = 1.1e-3;
  }
  SECTION("anywhere") {
    answer.largest_relative_error = 1.1e-3;
  }
  CHECK_THROWS_WITH(require_tolerance(1e-3, answer), Catch::Contains("more than the tolerance"));
  // Only a scene that forces an effect off is answered all the same.
  SceneEffect forced;
  forced.is_forced = forced.is_counted = true;
  answer.effects = {forced};
  require_tolerance(1e-3, answer);
  CHECK_FALSE(answer.within_tolerance);
  CHECK(has_note(answer, "more than the tolerance"));
}
