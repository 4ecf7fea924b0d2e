// Shapes that press on arrays of pillars that relax, in time.
#include "models/answer/scene_mistake.h"
#include "models/array/film/disc_charge.h"
#include "models/array/space/potential_spectrum.h"
#include "models/array/space/simulate_space.h"
#include "models/array/space/space_contact.h"
#include "models/array/space/touch_course.h"
#include "models/scene/plan.h"
#include "models/scene/simulate.h"
#include "tests/models/scene/touches.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <string>

using namespace viscard;
using namespace viscard::test;

namespace {

std::string mistake_of(const SpaceScene& scene) {
  try {
    plan_effects(scene);
  } catch (const SceneMistake& mistake) {
    return mistake.key() + ": " + mistake.what();
  }
  return "";
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("under a plane that is held the force relaxes as the modulus", "[models][array][space]") {
  const SceneAnswer answer = simulate(touched(2, 2, plane(), false, {{0.0, 1e-6}, {1.0, 1e-6}}));
  const SceneCurve& force = curve_of(answer, "contact_force");
  const SceneCurve& voltage = curve_of(answer, "mean_voltage_1_1");
  const SceneCurve& depth = curve_of(answer, "depth");
  REQUIRE(force.x.size() > 10);
  CHECK(force.value[1] == Approx(4.0 * 19.0468 * 1e-6).epsilon(2e-5));  // k of a graded mesh
  for (std::size_t k = 1; k < force.x.size(); ++k) {
    const double left = 1.0 - kShare * (1.0 - std::exp(-force.x[k] / kTau_s));
    CHECK(force.value[k] == Approx(left * force.value[1]).epsilon(1e-12));
    CHECK(voltage.value[k] == Approx(left * voltage.value[1]).epsilon(1e-12));
    CHECK(depth.value[k] == 1e-6);
    CHECK(force.error[k] > 0.0);
    CHECK(force.error[k] <= 5e-3 * force.value[1]);
  }
  CHECK(result_of(answer, "contact_force") == force.value.back());
  CHECK(result_of(answer, "contact_force_peak") == force.value[1]);
  // The maps are those of the end.
  CHECK(result_of(answer, "mean_voltage_1_1") == Approx(voltage.value.back()).epsilon(1e-12));
}

TEST_CASE("under a plane that comes down evenly the force is that of a ramp",
          "[models][array][space]") {
  const SceneAnswer answer = simulate(touched(1, 1, plane(), false, {{0.0, 0.0}, {0.5, 2e-6}}));
  const SceneCurve& force = curve_of(answer, "pillar_force_1_1");
  const double speed_m_s = 4e-6;
  const double k_N_m =
      result_of(answer, "pillar_force_1_1") /
      (speed_m_s * ((1.0 - kShare) * 0.5 + kShare * kTau_s * (1.0 - std::exp(-0.5 / kTau_s))));
  CHECK(k_N_m == Approx(19.0468).epsilon(2e-5));
  for (std::size_t k = 0; k < force.x.size(); ++k) {
    const double t_s = force.x[k];
    const double strained =
        (1.0 - kShare) * t_s + kShare * kTau_s * (1.0 - std::exp(-t_s / kTau_s));
    CHECK(force.value[k] == Approx(k_N_m * speed_m_s * strained).epsilon(1e-10).margin(1e-18));
  }
}

TEST_CASE("under a plane with a force the pillars creep and read the same",
          "[models][array][space]") {
  const SceneAnswer answer = simulate(touched(2, 1, plane(), true, {{0.0, 20e-6}, {2.0, 20e-6}}));
  const SceneCurve& depth = curve_of(answer, "depth");
  const SceneCurve& voltage = curve_of(answer, "mean_voltage_1_1");
  CHECK(depth.value[1] == Approx(10e-6 / 19.0468).epsilon(2e-5));
  for (std::size_t k = 1; k < depth.x.size(); ++k) {
    // Retardation of a standard solid: time tau/(1 - g), compliance g/(1 - g) more.
    const double more =
        kShare / (1.0 - kShare) * (1.0 - std::exp(-depth.x[k] * (1.0 - kShare) / kTau_s));
    CHECK(depth.value[k] == Approx((1.0 + more) * depth.value[1]).epsilon(1e-8));
    CHECK(std::abs(voltage.value[k] - voltage.value[1]) <=
          voltage.error[k] + 1e-9 * std::abs(voltage.value[1]));
  }
}

TEST_CASE("the errors of a touch in time hold", "[models][array][space][stability]") {
  for (const bool is_creep : {false, true}) {
    const double largest = is_creep ? 30e-6 : 2e-6;
    SpaceScene scene =
        touched(3, 3, paraboloid(400e-6), is_creep, {{0.0, 0.0}, {0.05, largest}, {1.0, largest}});
    scene.press->shape.x_m = 13e-6;
    scene.press->shape.y_m = -7e-6;
    scene.tolerance = 2e-2;
    const SceneAnswer answer = simulate(scene);
    scene.tolerance = 3e-3;
    const SceneAnswer finer = simulate(scene);
    INFO("creep " << is_creep);
    for (const SceneCurve& curve : answer.curves) {
      const SceneCurve& fine = curve_of(finer, curve.name);
      INFO(curve.name);
      for (const double time_s : {0.01, 0.03, 0.05, 0.11, 0.4, 1.0}) {
        // Both have the corners of the coarser steps; between them the polygons differ.
        const auto k = std::lower_bound(curve.x.begin(), curve.x.end(), time_s) - curve.x.begin();
        const auto i = static_cast<std::size_t>(k);
        CHECK(std::abs(curve.value[i] - at(fine, curve.x[i])) <=
              curve.error[i] + fine.error.back() + 1e-3 * largest_size(curve.value));
      }
      CHECK(*std::max_element(curve.error.begin(), curve.error.end()) <=
            (curve.name == "contacts" ? 1e9 : 2.001e-2) * largest_size(curve.value));
    }
  }
}

TEST_CASE("a charge amplifier lets the reading of a touch decay", "[models][array][space]") {
  SpaceScene scene = touched(1, 1, plane(), false, {{0.0, 1e-6}, {1.0, 1e-6}});
  scene.pillar.terms.clear();
  scene.film = pvdf_of_the_thesis(23e-12, 23e-12, -33e-12);
  scene.electrode = SpaceElectrode::kEquipotential;
  scene.touch->readout = Readout{ReadoutKind::kCharge, 1e12, 0.5e-12};
  const SceneAnswer answer = simulate(scene);
  const SceneCurve& reading = curve_of(answer, "reading_1_1");
  const SpaceArray array = array_of(scene);
  const DiscCharge charge(array.film, array.electrode_radius_m, 1, 6, 10);
  const double open_V = result_of(answer, "electrode_voltage_1_1");
  CHECK(reading.value[1] == Approx(charge.capacitance_F() / 0.5e-12 * open_V).epsilon(1e-5));
  for (std::size_t k = 1; k < reading.x.size(); ++k) {
    CHECK(reading.value[k] ==
          Approx(reading.value[1] * std::exp(-reading.x[k] / 0.5)).epsilon(1e-9));
    CHECK(reading.error[k] > 0.0);
  }
  CHECK(result_of(answer, "reading_1_1_peak") == reading.value[1]);
  CHECK(result_of(answer, "reading_1_1_end") == reading.value.back());
}

TEST_CASE("amplifiers at neighbouring electrodes change each other's readings",
          "[models][array][space]") {
  SpaceScene scene = touched(1, 2, plane(), false, {{0.0, 1e-6}, {1.0, 1e-6}});
  scene.pillar.terms.clear();
  scene.film = pvdf_of_the_thesis(23e-12, 23e-12, -33e-12);
  scene.electrode = SpaceElectrode::kEquipotential;
  scene.touch->readout = Readout{ReadoutKind::kVoltage, HUGE_VAL, 0.1e-12};
  const SceneAnswer answer = simulate(scene);
  const SpaceArray array = array_of(scene);
  const PotentialAccuracy accuracy = space_accuracies(array)[2].potential;
  const DiscCharge charge(array.film, array.electrode_radius_m, 1, 5, accuracy.film_degree);
  const double m = mutual_influence(array.film, charge, 100e-6, accuracy);
  CHECK(m == Approx(2.57e-3).epsilon(1e-2));
  // Two equal discs with equal open voltages: v = v_open - (1 + m) q/C, q = C_in v.
  const double C_F = charge.capacitance_F();
  const double exact = 1.0 / (1.0 + (1.0 + m) * 0.1e-12 / C_F);
  const double open_V = curve_of(answer, "electrode_voltage_1_1").value.back();
  CHECK(result_of(answer, "reading_1_1_end") / open_V == Approx(exact).epsilon(m * m));
}

TEST_CASE("voltages of close electrodes at the end of a touch are those of the map",
          "[models][array][space]") {
  SpaceScene scene = touched(1, 2, plane(), false, {{0.0, 1e-6}, {1.0, 1e-6}});
  scene.film = pvdf_of_the_thesis(23e-12, 23e-12, -33e-12);
  scene.electrode = SpaceElectrode::kEquipotential;
  scene.electrode_radius_m = 46e-6;
  CHECK(electrode_coupling(scene).is_on);
  const SceneAnswer answer = simulate(scene);
  // The charges are iterated to 2 % of the tolerance; without them the voltages are 2e-3 off.
  CHECK(curve_of(answer, "electrode_voltage_1_1").value.back() ==
        Approx(result_of(answer, "electrode_voltage_1_1")).epsilon(1e-4));
}

TEST_CASE("a film that leaks lets the reading of a touch fall faster", "[models][array][space]") {
  SpaceScene scene = touched(1, 1, plane(), false, {{0.0, 1e-6}, {1.0, 1e-6}});
  scene.electrode = SpaceElectrode::kEquipotential;
  scene.touch->readout = Readout{ReadoutKind::kVoltage, HUGE_VAL, 0.0, 0.25};
  const SceneAnswer answer = simulate(scene);
  const SceneCurve& reading = curve_of(answer, "reading_1_1");
  // V0 [g_inf e^(-t/T) + g (e^(-t/T)/T - e^(-t/tau)/tau)/(1/T - 1/tau)]: the high-pass of a step and of a
  // decay.
  for (std::size_t k = 1; k < reading.x.size(); ++k) {
    const double t_s = reading.x[k], T_s = 0.25;
    const double film = std::exp(-t_s / T_s), pillar = std::exp(-t_s / kTau_s);
    const double expected = (1.0 - kShare) * film +
                            kShare * (film / T_s - pillar / kTau_s) / (1.0 / T_s - 1.0 / kTau_s);
    CHECK(std::abs(reading.value[k] - reading.value[1] * expected) <= reading.error[k]);
    CHECK(reading.value[k] / reading.value[1] == Approx(expected).margin(2e-3));
  }
}

TEST_CASE("touches that have no answer are refused", "[models][array][space]") {
  const SpaceScene good = touched(2, 2, plane(), false, {{0.0, 0.0}, {0.1, 1e-6}, {1.0, 1e-6}});
  CHECK(mistake_of(good).empty());
  SpaceScene bad = good;
  bad.pillar.terms[0].k = 0.0;
  CHECK(contains(mistake_of(bad), "k = g"));
  bad = good;
  bad.others.push_back({40e-6, 120e-6, bad.pillar});
  bad.others[0].material.terms[0].tau_s = 1.0;
  CHECK(contains(mistake_of(bad), "geometry.classes"));
  bad = good;
  bad.touch->readout = Readout{};
  CHECK(contains(mistake_of(bad), "equipotential"));
  bad = good;
  bad.touch->history[0].time_s = 0.05;
  CHECK(contains(mistake_of(bad), "the first at 0 s"));
  bad = good;
  bad.touch->history[0].value = -1e-6;
  CHECK(contains(mistake_of(bad), "analysis.history.1"));
}

TEST_CASE("relaxation that the tolerance allows is left out of a touch", "[models][array][space]") {
  SpaceScene scene = touched(1, 1, plane(), false, {{0.0, 1e-6}, {1.0, 1e-6}});
  scene.pillar.terms = {{1e-3, 1e-3, kTau_s}};
  const SceneAnswer left_out = simulate(scene);
  scene.effects["relaxation"] = EffectChoice::kOn;
  const SceneAnswer on = simulate(scene);
  const SceneCurve& held = curve_of(left_out, "contact_force");
  const SceneCurve& relaxed = curve_of(on, "contact_force");
  CHECK(held.value.back() == held.value[1]);
  CHECK(relaxed.value.back() == Approx((1.0 - 1e-3) * held.value[1]).epsilon(2e-5));
  CHECK(held.value.back() - relaxed.value.back() <= held.error.back());
}
