#include "models/pillar/analyses/buckling_limit.h"
#include "models/pillar/analyses/simulate_pillar.h"
#include "models/pillar/body/piezo_static.h"
#include "models/scene/effects.h"
#include "models/scene/plan.h"
#include "models/scene/scene_effects.h"
#include "models/scene/simulate.h"
#include "tests/models/pillar/drive_as.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <set>

using namespace viscard;

namespace {

PillarScene pillar_on_film() {
  PillarScene scene;
  scene.pillar.E0_Pa = 1.8e6;
  scene.pillar.nu = 0.33;
  scene.pillar.rho_kg_m3 = 965.0;
  test::as<StaticDrive>(scene).pressure_Pa = 1e4;
  scene.geometry.film = FilmGeometry{25e-6, 60e-6};
  PiezoMatrix d = PiezoMatrix::Zero();
  d(2, 0) = d(2, 1) = 23e-12;
  d(2, 2) = -33e-12;
  scene.film = piezo_medium(isotropic_moduli_Pa(2e9, 0.29), d,
                            12.0 * kVacuumPermittivity_F_m * Eigen::Matrix3d::Identity(), 1780.0);
  return scene;
}

const SceneEffect& effect_of(const std::vector<SceneEffect>& all, const std::string& name) {
  for (const SceneEffect& effect : all) {
    if (effect.name == name) return effect;
  }
  throw std::runtime_error("no effect " + name);
}

double value_of(const SceneAnswer& answer, const std::string& name) {
  for (const SceneResult& result : answer.results) {
    if (result.name == name) return result.value;
  }
  throw std::runtime_error("no result " + name);
}

}  // namespace

TEST_CASE("a film that is left out costs the same as a scene without film", "[pillar][plan]") {
  PillarScene with_film = pillar_on_film();
  with_film.wanted = {"top_displacement"};
  PillarScene without = with_film;
  without.film.reset();
  without.geometry.film.reset();
  SceneAnswer planned, never;
  SECTION("because the tolerance allows it") {
    with_film.tolerance = 1e-3;
  }
  SECTION("because the scene says so") {
    with_film.tolerance = 1e-5;
    with_film.effects["film_compliance"] = EffectChoice::kOff;
  }
  const ScenePlan plan = plan_effects(with_film);
  CHECK_FALSE(effect_of(plan.effects, "film_compliance").on);
  planned = simulate(with_film);
  without.tolerance = common(plan.reduced).tolerance;
  never = simulate_pillar(without);
  CHECK(planned.unknowns == never.unknowns);
  CHECK(value_of(planned, "top_displacement") == value_of(never, "top_displacement"));
  // The film's share is known: 659.763 against 659.692 nm.
  const SceneResult& top = planned.results.front();
  CHECK(std::abs(top.value + 659.763e-9) <= top.error_estimate);
}

TEST_CASE("a film whose share exceeds the tolerance is on", "[pillar][plan]") {
  PillarScene scene = pillar_on_film();
  scene.wanted = {"top_displacement"};
  scene.tolerance = 1e-4;
  CHECK(effect_of(plan_effects(scene).effects, "film_compliance").on);
}

TEST_CASE("the film's estimates exceed its true shares, by less than four times",
          "[pillar][plan]") {
  // Shares of the film of 25 um under the pillar of 40 x 120 um: top displacement 659.763 against
  // 659.692 nm, buckling 29.3648 against 29.3689 kPa, the lateral mode under 10 kPa 13253.58 against
  // 13251.23 Hz.
  PillarScene scene = pillar_on_film();
  scene.wanted = {"top_displacement"};
  double share = 659.763 / 659.692 - 1.0;
  SECTION("deflection") {}
  SECTION("buckling") {
    scene.drive = BucklingDrive{};
    share = 29.3689 / 29.3648 - 1.0;
  }
  SECTION("modes") {
    scene.drive = ModalDrive{.modes = 4, .pressure_Pa = 1e4};
    share = 13253.58 / 13251.23 - 1.0;
  }
  const double estimate = film_compliance_estimate(scene).error;
  CHECK(estimate >= share);
  CHECK(estimate <= 4.0 * share);
}

TEST_CASE("an effect forced off although a result needs it is refused by name", "[pillar][plan]") {
  PillarScene scene = pillar_on_film();
  scene.wanted = {"film_bottom_stress_mean"};
  scene.effects["film_compliance"] = EffectChoice::kOff;
  CHECK_THROWS_WITH(plan_effects(scene), Catch::Contains("cannot be off"));
  scene.effects = {{"film_complience", EffectChoice::kOff}};
  CHECK_THROWS_WITH(plan_effects(scene), Catch::Contains("film_complience"));
}

TEST_CASE("the error of effects left out stays within half the tolerance and enters the estimate",
          "[pillar][plan]") {
  PillarScene scene = pillar_on_film();
  scene.wanted = {"top_displacement"};
  scene.tolerance = GENERATE(1e-1, 1e-2, 1e-3, 1e-4, 1e-5);
  const ScenePlan plan = plan_effects(scene);
  double sum = 0.0;
  for (const SceneEffect& effect : plan.effects) {
    if (effect.is_counted) sum += effect.estimate;
  }
  CHECK(sum == Approx(plan.left_out).epsilon(1e-12).margin(0.0));
  CHECK(sum <= 0.5 * scene.tolerance);
  CHECK(common(plan.reduced).tolerance + sum <= scene.tolerance * (1.0 + 1e-12));
  if (scene.tolerance < 1e-4) return;
  const SceneAnswer answer = simulate(scene);
  CHECK(answer.results.front().error_estimate >= sum * std::abs(answer.results.front().value));
}

// An effect that is off leaves less of the tolerance to the mesh, which may then be another one.
constexpr Discretisation kSameMesh{.degree = 6, .layers = 3};

TEST_CASE("one-way potentials differ from coupled ones by about k^2", "[pillar][plan]") {
  PillarScene scene = pillar_on_film();
  scene.electrodes = ElectrodeOptions{FilmFace::kBottom, 20e-6};
  scene.wanted = {"electrode_voltage"};
  scene.tolerance = 1e-2;
  scene.discretisation = kSameMesh;
  scene.effects["piezo_coupling"] = EffectChoice::kOff;
  const SceneAnswer one_way = simulate(scene);
  scene.effects["piezo_coupling"] = EffectChoice::kOn;
  const SceneAnswer coupled = simulate(scene);
  const double change =
      value_of(one_way, "electrode_voltage") / value_of(coupled, "electrode_voltage") - 1.0;
  const double estimate = piezo_coupling_estimate(scene).error;
  CHECK(std::abs(change) > 0.1 * estimate);
  CHECK(std::abs(change) < estimate);
  CHECK(one_way.unknowns < coupled.unknowns);
}

TEST_CASE("without piezoelectric constants one-way and two-way coupling agree, with no voltage",
          "[pillar][plan]") {
  // Weak coupling: the one-way error falls with the square of the charge constants.
  const auto change_for = [](double factor) {
    PillarScene scene = pillar_on_film();
    scene.film->piezo_C_m2 *= factor;
    scene.film->permittivity_F_m.setIdentity();
    scene.film->permittivity_F_m *= 12.0 * kVacuumPermittivity_F_m;
    scene.electrodes = ElectrodeOptions{FilmFace::kBottom, 20e-6};
    scene.wanted = {"electrode_voltage"};
    scene.tolerance = 1e-2;
    scene.discretisation = kSameMesh;
    scene.effects["piezo_coupling"] = EffectChoice::kOff;
    const double one_way = value_of(simulate(scene), "electrode_voltage");
    scene.effects["piezo_coupling"] = EffectChoice::kOn;
    return one_way / value_of(simulate(scene), "electrode_voltage") - 1.0;
  };
  CHECK(change_for(0.1) / change_for(1.0) == Approx(0.01).epsilon(0.1));
}

TEST_CASE("relaxation too slow for a history is left out", "[pillar][plan]") {
  PillarScene scene = pillar_on_film();
  scene.film.reset();
  scene.geometry.film.reset();
  scene.drive = CreepDrive{{{0.0, 1e4}, {1e-2, 1e4}}};
  scene.pillar.terms = {{0.02, 0.02, 100.0}};
  scene.tolerance = 1e-2;
  const ScenePlan plan = plan_effects(scene);
  CHECK_FALSE(effect_of(plan.effects, "relaxation").on);
  CHECK(common(plan.reduced).pillar.terms.empty());
  test::as<CreepDrive>(scene).history.back().time_s = 1e3;
  CHECK(effect_of(plan_effects(scene).effects, "relaxation").on);
}

TEST_CASE("modes of a relaxed solid vibrate with its remaining modulus", "[pillar][plan]") {
  PillarScene scene = pillar_on_film();
  scene.film.reset();
  scene.geometry.film.reset();
  scene.drive = ModalDrive{.modes = 1};
  scene.pillar.terms = {{0.19, 0.19, 1e-12}};  // relaxed long before any mode
  scene.effects["relaxation"] = EffectChoice::kOn;
  scene.tolerance = 1e-2;
  const SceneAnswer relaxed = simulate(scene);
  scene.effects["relaxation"] = EffectChoice::kOff;
  const SceneAnswer instantaneous = simulate(scene);
  REQUIRE(relaxed.modes.size() == instantaneous.modes.size());
  for (std::size_t i = 0; i < relaxed.modes.size(); ++i) {
    CHECK(relaxed.modes[i].frequency_Hz / instantaneous.modes[i].frequency_Hz ==
          Approx(0.9).epsilon(1e-9));  // sqrt(1 - 0.19)
  }
}

// A random scene whose lateral mode was 17 407 +- 150 Hz without the film, and 16 912 Hz with it.
TEST_CASE("near buckling a film changes the lateral mode more than it bends the foot",
          "[pillar][plan]") {
  PillarScene scene;
  scene.tolerance = 0.0476;
  scene.geometry.diameter_m = 37e-6;
  scene.geometry.length_m = 105.7e-6;
  scene.geometry.film = FilmGeometry{7.63e-6, 18.5e-6};
  scene.pillar = {.E0_Pa = 56.56e6, .nu = 0.25737, .rho_kg_m3 = 1298.8, .terms = {}};
  scene.pillar.terms = {{.g = 0.05114, .k = 0.05114, .tau_s = 2.2259e-6},
                        {.g = 0.08405, .k = 0.08405, .tau_s = 1.01123e-7}};
  scene.film = isotropic_medium(4.119e9, 0.3088, 5309.0);
  scene.drive = ModalDrive{.modes = 1};
  const double limit_Pa = engesser_pressure_Pa(long_term_scene(scene));
  for (const double share : {0.0, 0.5, 0.955}) {
    CAPTURE(share);
    test::as<ModalDrive>(scene).pressure_Pa = share * limit_Pa;
    const Discretisation mesh{.degree = 5, .layers = 2};
    const SceneAnswer with_film = answer_on(scene, mesh);
    PillarScene without = scene;
    without.film.reset();
    without.geometry.film.reset();
    const SceneAnswer none = answer_on(without, mesh);
    const double change =
        std::abs(none.modes[0].frequency_Hz / with_film.modes[0].frequency_Hz - 1.0);
    const double estimate = effect_of(plan_effects(scene).effects, "film_compliance").estimate;
    CHECK(change <= estimate);
    CHECK(estimate <= 5.0 * change);
  }
}

TEST_CASE("Engesser's pressure agrees with the solver's within 2 % at three diameters",
          "[pillar][plan]") {
  CHECK(engesser_pressure_Pa(pillar_on_film()) == Approx(29368.9).epsilon(0.02));
}

TEST_CASE("every effect states its change and its cost, under a unique name", "[pillar][plan]") {
  std::set<std::string> names;
  for (const Effect& effect : effects()) {
    CHECK(names.insert(effect.name).second);
    CHECK(std::string(effect.changes).size() > 5);
    CHECK(std::string(effect.cost).size() > 5);
  }
  CHECK(names.size() == 19);
}

TEST_CASE("every kind of sideways load bends without buckling, and bending gives the strain",
          "[pillar][plan]") {
  PillarScene scene = pillar_on_film();
  const double shear_Pa = 1e5;  // along the pillar it would be beyond buckling
  SECTION("at rest") {
    scene.drive = StaticDrive{.direction = LoadDirection::kLateral, .pressure_Pa = shear_Pa};
  }
  SECTION("oscillating") {
    scene.drive = HarmonicDrive{.direction = LoadDirection::kLateral,
                                .pressure_Pa = shear_Pa,
                                .frequencies_Hz = {1.0, 10.0}};
  }
  SECTION("in time") {
    scene.drive = TransientDrive{.direction = LoadDirection::kLateral,
                                 .history = {{0.0, 0.0}, {1e-3, shear_Pa}},
                                 .end_time_s = 2e-3};
  }
  CHECK_NOTHROW(refuse_beyond_buckling(scene));
  const SceneEffect strain = effect_of(plan_effects(scene).effects, "finite_strain");
  // A beam's outermost fibre at the foot: M R/I = 4 tau L/R.
  CHECK(strain.value == Approx(4.0 * 1e5 * 120.0 / 20.0 / 1.8e6).epsilon(1e-9));
}

TEST_CASE("a transient push beyond buckling is reported", "[pillar][plan]") {
  PillarScene scene = pillar_on_film();
  scene.drive = TransientDrive{.history = {{0.0, 0.0}, {1e-3, 1e5}}, .end_time_s = 2e-3};
  const SceneEffect buckling = effect_of(plan_effects(scene).effects, "geometric_stiffness");
  CHECK(buckling.estimate == 1.0);
  CHECK(buckling.value > 3.0);
  test::as<TransientDrive>(scene).history.back().value = 1e4;
  CHECK(effect_of(plan_effects(scene).effects, "geometric_stiffness").estimate == 0.0);
}

TEST_CASE("an oscillating push is judged by its amplitude", "[pillar][plan]") {
  PillarScene scene = pillar_on_film();
  scene.drive = HarmonicDrive{.pressure_Pa = -1e5, .frequencies_Hz = {1.0}};
  CHECK_THROWS_WITH(refuse_beyond_buckling(scene), Catch::Contains("buckling"));
}
