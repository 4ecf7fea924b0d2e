// An effect that is off costs nothing: its scene has the unknowns of one that never had it, and
// gives the same numbers to the last bit: nothing of the effect is assembled or solved.
#include "models/array/plane/simulate_array.h"
#include "models/pillar/analyses/simulate_pillar.h"
#include "models/scene/plan.h"
#include "models/scene/simulate.h"
#include "tests/models/pillar/drive_as.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <functional>

using namespace viscard;

namespace {

Medium piezo_film() {
  PiezoMatrix d = PiezoMatrix::Zero();
  d(2, 0) = d(2, 1) = 23e-12;
  d(2, 2) = -33e-12;
  return piezo_medium(isotropic_moduli_Pa(2e9, 0.29), d,
                      12.0 * kVacuumPermittivity_F_m * Eigen::Matrix3d::Identity(), 1780.0);
}

PillarScene pillar_on_film() {
  PillarScene scene;
  scene.tolerance = 1e-2;
  scene.pillar.E0_Pa = 1.8e6;
  scene.pillar.nu = 0.33;
  scene.pillar.rho_kg_m3 = 965.0;
  test::as<StaticDrive>(scene).pressure_Pa = 1e4;
  scene.geometry.film = FilmGeometry{25e-6, 60e-6};
  scene.film = piezo_film();
  scene.wanted = {"top_displacement"};
  return scene;
}

ArrayScene row_of_four() {
  ArrayScene scene;
  scene.tolerance = 1e-2;
  scene.pillar.E0_Pa = 1.8e6;
  scene.pillar.nu = 0.33;
  scene.pillar.rho_kg_m3 = 965.0;
  scene.film = piezo_film();
  scene.load_Pa = 1e3;
  scene.geometry.count = 4;
  return scene;
}

// The numbers of an answer and its cost.
struct Told {
  int unknowns = 0;
  std::vector<double> numbers;
  bool operator==(const Told&) const = default;
};

Told told(const SceneAnswer& answer) {
  Told told{answer.unknowns, {}};
  for (const SceneResult& r : answer.results) told.numbers.push_back(r.value);
  for (const SceneMode& m : answer.modes) told.numbers.push_back(m.frequency_Hz);
  for (const SceneCurve& c : answer.curves) {
    told.numbers.insert(told.numbers.end(), c.value.begin(), c.value.end());
  }
  return told;
}

// The scene with one effect as chosen, on the mesh that the rest of the tolerance asks for.
Told with_choice(PillarScene scene, const std::string& effect, EffectChoice choice) {
  scene.effects[effect] = choice;
  auto reduced = std::get<PillarScene>(plan_effects(scene).reduced);
  reduced.tolerance = scene.tolerance;
  SceneAnswer answer = simulate_pillar(reduced);
  return told(answer);
}
Told with_choice(ArrayScene scene, const std::string& effect, EffectChoice choice) {
  scene.effects[effect] = choice;
  auto reduced = std::get<ArrayScene>(plan_effects(scene).reduced);
  reduced.tolerance = scene.tolerance;
  return told(simulate_array(reduced));
}

struct Case {
  const char* effect;
  std::function<void(PillarScene&)> set_up;     // makes the effect matter
  std::function<void(PillarScene&)> never_had;  // takes its cause away
  bool adds_unknowns;
};

void without_film(PillarScene& s) {
  s.film.reset();
  s.geometry.film.reset();
}

void creeps(PillarScene& s) {
  without_film(s);
  s.drive = CreepDrive{{{0.0, 1e4}, {2.0, 1e4}}};
  s.pillar.terms = {{0.1, 0.1, 0.5}};
}

void vibrates_under_pressure(PillarScene& s) {
  without_film(s);
  s.drive = ModalDrive{.modes = 1, .pressure_Pa = 1e4};
}

}  // namespace

TEST_CASE("an effect of one pillar that is off costs nothing", "[pillar][plan]") {
  const Case one = GENERATE(
      values<Case>({{"film_compliance", [](PillarScene&) {}, without_film, true},
                    {"piezo_coupling",
                     [](PillarScene& s) {
                       s.electrodes = ElectrodeOptions{FilmFace::kBottom, 20e-6};
                       s.effects["film_compliance"] = EffectChoice::kOn;
                     },
                     [](PillarScene& s) { s.electrodes.reset(); }, true},
                    {"relaxation", creeps, [](PillarScene& s) { s.pillar.terms.clear(); }, false},
                    {"relaxation",
                     [](PillarScene& s) {
                       vibrates_under_pressure(s);
                       test::as<ModalDrive>(s).pressure_Pa = 0.0;
                       s.pillar.terms = {{0.1, 0.1, 1e-9}};
                     },
                     [](PillarScene& s) { s.pillar.terms.clear(); }, false},
                    {"geometric_stiffness", vibrates_under_pressure,
                     [](PillarScene& s) { test::as<ModalDrive>(s).pressure_Pa = 0.0; }, false},
                    {"incompressibility",
                     [](PillarScene& s) {
                       without_film(s);
                       s.pillar.nu = 0.499;
                     },
                     [](PillarScene& s) { s.condense_pressures_from = 0.5; }, false}}));
  CAPTURE(one.effect);
  PillarScene scene = pillar_on_film();
  one.set_up(scene);
  PillarScene never = scene;
  one.never_had(never);
  const Told off = with_choice(scene, one.effect, EffectChoice::kOff);
  CHECK(off == told(simulate_pillar(never)));
  const Told on = with_choice(scene, one.effect, EffectChoice::kOn);
  CHECK(off.numbers != on.numbers);
  if (one.adds_unknowns) CHECK(off.unknowns < on.unknowns);
}

TEST_CASE("a static answer assembles no mass, and an open electrode no readout", "[pillar][plan]") {
  PillarScene scene = pillar_on_film();
  scene.electrodes = ElectrodeOptions{FilmFace::kBottom, 20e-6};
  scene.wanted = {"electrode_voltage"};
  const Told with_mass = told(simulate(scene));
  scene.pillar.rho_kg_m3 *= 1e3;
  CHECK(told(simulate(scene)) == with_mass);
  // The readout is a filter behind the same voltage: a few numbers more, no unknown.
  creeps(scene);
  scene.geometry.film = FilmGeometry{25e-6, 60e-6};
  scene.film = piezo_film();
  const SceneAnswer open = simulate(scene);
  scene.readout = Readout{};
  scene.wanted = {"electrode_voltage", "reading"};
  const SceneAnswer read = simulate(scene);
  CHECK(open.unknowns == read.unknowns);
  const auto has_reading = [](const SceneAnswer& a) {
    return std::any_of(a.results.begin(), a.results.end(),
                       [](const SceneResult& r) { return r.name.starts_with("reading"); });
  };
  CHECK_FALSE(has_reading(open));
  CHECK(has_reading(read));
}

TEST_CASE("an effect of a row that is off costs nothing", "[array][plan]") {
  ArrayScene scene = row_of_four();
  SECTION("neighbours: the unknowns of one pillar, however many there are") {
    scene.wanted = {"centre_voltage"};
    const Told off = with_choice(scene, "crosstalk", EffectChoice::kOff);
    const Told on = with_choice(scene, "crosstalk", EffectChoice::kOn);
    scene.geometry.count = 40;
    CHECK(with_choice(scene, "crosstalk", EffectChoice::kOff).unknowns == off.unknowns);
    CHECK(off.unknowns < on.unknowns);
    CHECK(off.numbers != on.numbers);
  }
  SECTION("film: a pillar of its own on a rigid base") {
    scene.wanted = {"top_displacement"};
    const Told off = with_choice(scene, "film_compliance", EffectChoice::kOff);
    PillarScene one = single_pillar(scene);
    one.drive = StaticDrive{.pressure_Pa = scene.load_Pa};
    one.wanted = scene.wanted;
    const SceneAnswer never = simulate_pillar(one);
    CHECK(off.numbers == std::vector<double>(4, never.results.front().value));
    CHECK(off.unknowns < with_choice(scene, "film_compliance", EffectChoice::kOn).unknowns);
  }
  SECTION("coupling: a film without potential") {
    scene.wanted = {"top_displacement"};
    scene.effects["film_compliance"] = EffectChoice::kOn;
    scene.effects["crosstalk"] = EffectChoice::kOn;
    const Told off = with_choice(scene, "piezo_coupling", EffectChoice::kOff);
    ArrayScene never = scene;
    never.film = isotropic_medium(2e9, 0.29, 1780.0);
    CHECK(off == told(simulate_array(never)));
    CHECK(off.unknowns < with_choice(scene, "piezo_coupling", EffectChoice::kOn).unknowns);
  }
  SECTION("adhesion and mass: formulas only") {
    const Told usual = told(simulate(scene));
    scene.surface_energy_J_m2 *= 100.0;
    scene.pillar.rho_kg_m3 *= 1e3;
    CHECK(told(simulate(scene)) == usual);
  }
}
