// A film that loses, as an effect of scenes (eq. 23b, E16).
#include "models/scene/plan.h"
#include "models/scene/simulate.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

using namespace viscard;

namespace {

PillarScene on_pvdf(PillarDrive drive) {
  PillarScene scene;
  scene.geometry.diameter_m = 40e-6;
  scene.geometry.length_m = 120e-6;
  scene.geometry.film = FilmGeometry{25e-6, 60e-6};
  PiezoMatrix d = PiezoMatrix::Zero();
  d(2, 0) = d(2, 1) = 23e-12;
  d(2, 2) = -33e-12;
  const Eigen::Matrix3d permittivity = 12.0 * kVacuumPermittivity_F_m * Eigen::Matrix3d::Identity();
  scene.film = piezo_medium(isotropic_moduli_Pa(2e9, 0.29), d, permittivity, 1780.0);
  scene.film_charge_C_N = d;
  scene.electrodes = ElectrodeOptions{FilmFace::kBottom, 20e-6};
  scene.pillar.E0_Pa = 1.8e6;
  scene.pillar.nu = 0.33;
  scene.pillar.rho_kg_m3 = 965.0;
  scene.drive = std::move(drive);
  return scene;
}

PillarScene held_press(FilmLoss loss) {
  PillarScene scene = on_pvdf(CreepDrive{{{0.0, 0.0}, {0.01, 1e4}, {10.0, 1e4}}});
  scene.film_loss = std::move(loss);
  return scene;
}

const SceneCurve& curve_named(const SceneAnswer& answer, const std::string& name) {
  for (const SceneCurve& curve : answer.curves) {
    if (curve.name == name) return curve;
  }
  throw std::runtime_error("no curve " + name);
}

SceneEffect loss_effect(const Scene& scene) {
  for (const SceneEffect& one : plan_effects(scene).effects) {
    if (one.name == "dielectric_loss") return one;
  }
  throw std::runtime_error("no effect");
}

// Largest difference of two curves over the peak of the first.
double difference(const SceneCurve& whole, const SceneCurve& other) {
  double largest = 0.0;
  for (std::size_t i = 0; i < whole.x.size(); ++i) {
    const auto at = std::lower_bound(other.x.begin(), other.x.end(), whole.x[i]);
    if (at == other.x.end() || *at != whole.x[i]) continue;  // other times
    const double value = other.value[static_cast<std::size_t>(at - other.x.begin())];
    largest = std::max(largest, std::abs(whole.value[i] - value));
  }
  return largest / largest_size(whole.value);
}

}  // namespace

TEST_CASE("the voltage of a press that stays leaks away", "[models][scene]") {
  const SceneAnswer answer = simulate(held_press({.leakage_s = 100.0}));
  const SceneCurve& voltage = curve_named(answer, "electrode_voltage");
  const SceneAnswer ideal = simulate(held_press({}));
  const double at_once_V = curve_named(ideal, "electrode_voltage").value.back();
  // The capacitance that strain adds, 1.1 % here, keeps its charge: the time is some longer.
  const double T_s = -10.0 / std::log(voltage.value.back() / at_once_V);
  CHECK(T_s == Approx(100.0 * 1.011).epsilon(5e-3));
  CHECK(loss_effect(held_press({.leakage_s = 100.0})).on);
}

TEST_CASE("a film without known losses gives what it gave", "[models][scene]") {
  const SceneEffect effect = loss_effect(held_press({}));
  CHECK_FALSE(effect.on);
  CHECK(effect.estimate == 0.0);
  // Losses are nothing to a load at rest.
  PillarScene at_rest = on_pvdf(StaticDrive{.pressure_Pa = 1e4});
  at_rest.film_loss = {.leakage_s = 1.0, .terms = {{0.5, 1.0}}};
  CHECK_FALSE(loss_effect(at_rest).on);
  PillarScene ideal = at_rest;
  ideal.film_loss = {};
  CHECK(simulate(at_rest).results[0].value == simulate(ideal).results[0].value);
}

TEST_CASE("the estimate of a film's losses covers what leaving them out changes",
          "[models][scene]") {
  const std::vector<FilmLoss> losses = {{.leakage_s = 300.0},
                                        {.leakage_s = 3.0},
                                        {.terms = {{0.05, 1e-3}}},
                                        {.terms = {{0.3, 2.0}, {0.1, 50.0}}},
                                        {.leakage_s = 30.0, .terms = {{0.02, 0.1}}}};
  const SceneAnswer ideal = simulate(held_press({}));
  for (const FilmLoss& loss : losses) {
    const SceneAnswer lossy = simulate(held_press(loss));
    const double change = difference(curve_named(ideal, "electrode_voltage"),
                                     curve_named(lossy, "electrode_voltage"));
    const double estimate = loss_effect(held_press(loss)).estimate;
    CHECK(change > 0.0);
    CHECK(change <= estimate);
    CHECK(estimate <= 2.5 * change + 1e-4);
  }
}

TEST_CASE("a late polarisation that is there at once is a larger permittivity", "[models][scene]") {
  PillarScene fast = on_pvdf(HarmonicDrive{.pressure_Pa = 1e4, .frequencies_Hz = {1.0, 10.0}});
  PillarScene larger = fast;
  fast.film_loss = {.terms = {{0.5, 1e-12}}};
  larger.film->permittivity_F_m *= 1.5;
  for (const bool is_sampled : {false, true}) {
    const std::string name = is_sampled ? "potential_at_centre" : "electrode_voltage";
    if (is_sampled) {
      fast.electrodes->electrode_radius_m = larger.electrodes->electrode_radius_m = 0.0;
      fast.tolerance = larger.tolerance = 2e-2;  // eps^S to eps^T: 2.3 % of the third that is lost
    }
    const SceneCurve by_term = curve_named(simulate(fast), name + "_magnitude");
    const SceneCurve by_film = curve_named(simulate(larger), name + "_magnitude");
    for (std::size_t i = 0; i < 2; ++i) {
      CHECK(std::abs(by_term.value[i] - by_film.value[i]) <= by_term.error[i] + by_film.error[i]);
    }
  }
}

TEST_CASE("a row's voltages fall by one factor for all", "[models][scene]") {
  ArrayScene row;
  row.geometry = {.count = 3, .diameter_m = 40e-6, .length_m = 120e-6};
  row.geometry.spacing_m = 60e-6;
  row.geometry.film_thickness_m = 25e-6;
  const PillarScene one = on_pvdf(StaticDrive{});
  row.film = *one.film;
  row.pillar = one.pillar;
  row.tolerance = 5e-2;  // of 2.3 % of what is lost, eps^S to eps^T, no mesh knows better
  row.load_Pa = 1e3;
  row.loaded = {2};
  row.drive = RowHarmonic{{10.0, 100.0}};
  ArrayScene lossy = row;
  lossy.film_loss = {.leakage_s = 0.01, .terms = {{0.1, 1e-3}}};
  CHECK(loss_effect(lossy).on);
  const SceneAnswer before = simulate(row), after = simulate(lossy);
  std::size_t voltages = 0;
  for (const SceneCurve& curve : before.curves) {
    if (curve.unit != "V" || !curve.name.ends_with("_magnitude")) continue;
    ++voltages;
    const SceneCurve& fallen = curve_named(after, curve.name);
    for (std::size_t i = 0; i < 2; ++i) {
      const double omega = 2.0 * std::numbers::pi * curve.x[i];
      const FilmPort port = bonded_port(row.film, lossy.film_loss);
      CHECK(fallen.value[i] ==
            Approx(std::abs(response(open_filter(port), omega)) * curve.value[i]).epsilon(1e-9));
    }
  }
  CHECK(voltages == 3);
}
