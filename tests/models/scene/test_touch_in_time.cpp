// Shapes that press on arrays of pillars that relax, in time.
#include "models/array/space/disc_charge.h"
#include "models/array/space/potential_spectrum.h"
#include "models/array/space/simulate_space.h"
#include "models/array/space/space_contact.h"
#include "models/array/space/touch_course.h"
#include "models/pillar/mesh/scene_mistake.h"
#include "models/scene/plan.h"
#include "models/scene/simulate.h"
#include "tests/models/array/space/film_of_the_thesis.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <string>

using namespace viscard;
using namespace viscard::test;

namespace {

using History = std::vector<HistoryPoint>;
constexpr double kShare = 0.3, kTau_s = 0.2;  // of the only term

RigidShape plane() {
  return {.kind = ShapeKind::kPlane, .table = {}};
}
RigidShape paraboloid(double radius_m) {
  return {.kind = ShapeKind::kParaboloid, .radius_m = radius_m, .table = {}};
}

SpaceScene touched(int rows, int columns, const RigidShape& shape, bool is_creep,
                   const History& history) {
  SpaceScene scene;
  scene.pillar.E0_Pa = 1.8e6;
  scene.pillar.nu = 0.33;
  scene.pillar.rho_kg_m3 = 965.0;
  scene.pillar.terms = {{kShare, kShare, kTau_s}};
  scene.film = pvdf_of_the_thesis();
  scene.rows = rows;
  scene.columns = columns;
  scene.pillars = lattice_places(SpaceLattice::kSquare, rows, columns, 100e-6);
  scene.film_edge_m = 300e-6;
  scene.tolerance = 5e-3;
  scene.press = ShapePress{.shape = shape};
  press_in_time(scene, {.is_creep = is_creep, .history = history, .readout = {}});
  return scene;
}

const SceneCurve& curve_of(const SceneAnswer& answer, const std::string& name) {
  const auto found = std::find_if(answer.curves.begin(), answer.curves.end(),
                                  [&](const SceneCurve& one) { return one.name == name; });
  if (found == answer.curves.end()) throw std::runtime_error("no curve " + name);
  return *found;
}

double result_of(const SceneAnswer& answer, const std::string& name) {
  for (const SceneResult& one : answer.results) {
    if (one.name == name) return one.value;
  }
  throw std::runtime_error("no result " + name);
}

// At a time of a curve without jumps.
double at(const SceneCurve& curve, double time_s) {
  const auto next = std::upper_bound(curve.x.begin(), curve.x.end(), time_s) - curve.x.begin();
  const auto k =
      static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(next, 1, std::ssize(curve.x) - 1));
  const double share = (time_s - curve.x[k - 1]) / (curve.x[k] - curve.x[k - 1]);
  return curve.value[k - 1] + share * (curve.value[k] - curve.value[k - 1]);
}

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

// Springs with one Maxwell branch each under a surface at heights h_i that only pushes them, stepped in
// time by equal steps with the depth or the total force given: no correspondence is used.
struct SpringStep {
  double time_s = 0.0, depth_m = 0.0, sum_N = 0.0;
  std::vector<double> force_N;
};
struct Springs {
  std::vector<double> h_m;
  double k_N_m = 19.0468, share = kShare;
  bool is_force = false;  // what the history is
  History history;
};
std::vector<SpringStep> stepped(const Springs& springs, int steps) {
  const std::size_t n = springs.h_m.size();
  const double dt_s = springs.history.back().time_s / steps, x = dt_s / kTau_s;
  const double decay = std::exp(-x), of_step = springs.share * (1.0 - decay) / x;
  const double now = 1.0 - springs.share + of_step;
  std::vector<double> branch_m(n, 0.0), way_m(n, 0.0);
  std::vector<SpringStep> all;
  for (int step = 1; step <= steps; ++step) {
    SpringStep one{step * dt_s, 0.0, 0.0, std::vector<double>(n)};
    const auto sum_at = [&](double depth_m) {
      one.depth_m = depth_m;
      one.sum_N = 0.0;
      for (std::size_t i = 0; i < n; ++i) {
        const double carried_m = decay * branch_m[i] - of_step * way_m[i];
        one.force_N[i] =
            std::max(springs.k_N_m * (now * (depth_m - springs.h_m[i]) + carried_m), 0.0);
        one.sum_N += one.force_N[i];
      }
      return one.sum_N;
    };
    const double given = value_at(springs.history, one.time_s);
    if (springs.is_force) {
      double low_m = -20e-6, high_m = 20e-6;
      for (int i = 0; i < 50; ++i) {
        const double middle_m = 0.5 * (low_m + high_m);
        (sum_at(middle_m) < given ? low_m : high_m) = middle_m;
      }
      sum_at(high_m);
    } else {
      sum_at(given);
    }
    for (std::size_t i = 0; i < n; ++i) {
      const double carried_m = decay * branch_m[i] - of_step * way_m[i];
      const double next_m = (one.force_N[i] / springs.k_N_m - carried_m) / now;
      branch_m[i] = decay * branch_m[i] + of_step * (next_m - way_m[i]);
      way_m[i] = next_m;
    }
    all.push_back(std::move(one));
  }
  return all;
}
const SpringStep& at(const std::vector<SpringStep>& steps, double time_s) {
  const double dt_s = steps.front().time_s;
  return steps[static_cast<std::size_t>(std::lround(time_s / dt_s)) - 1];
}

// Mean gaps over the tops of a scene under a paraboloid.
std::vector<double> mean_gaps_m(const SpaceScene& scene) {
  std::vector<double> h_m;
  for (const SpacePillar& one : scene.pillars) {
    h_m.push_back((one.x_m * one.x_m + one.y_m * one.y_m + 2e-10) /
                  (2.0 * scene.press->shape.radius_m));
  }
  return h_m;
}

TEST_CASE("under a paraboloid with a force the contact grows", "[models][array][space]") {
  constexpr double kRadius_m = 20e-3, kForce_N = 110e-6, kEnd_s = 2.0;
  constexpr double kMost = 0.6;  // of the modulus relaxes
  SpaceScene scene = touched(4, 4, paraboloid(kRadius_m), true,
                             {{0.0, 0.0}, {0.02, kForce_N}, {kEnd_s, kForce_N}});
  scene.pillar.terms = {{kMost, kMost, kTau_s}};
  press_in_time(scene, *scene.touch);
  scene.wanted = {"depth", "contacts", "pillar_force_2_2", "pillar_force_1_1", "mean_voltage_2_2"};
  const SceneAnswer answer = simulate(scene);
  const std::vector<SpringStep> springs =
      stepped({mean_gaps_m(scene), 19.0468, kMost, true, scene.touch->history}, 8000);
  const double ramp_depth_m = at(springs, 0.02).depth_m, depth_m = springs.back().depth_m;
  const std::vector<double>& force_N = springs.back().force_N;
  const SceneCurve& depth = curve_of(answer, "depth");
  CHECK(at(depth, 0.02) == Approx(ramp_depth_m).epsilon(2e-3));
  CHECK(depth.value.back() == Approx(depth_m).epsilon(2e-3));
  CHECK(result_of(answer, "pillar_force_2_2") ==
        Approx(force_N[*index_of(scene, {2, 2})]).epsilon(2e-3));
  const double largest_N = result_of(answer, "pillar_force_2_2");
  CHECK(result_of(answer, "pillar_force_1_1") ==
        Approx(force_N[*index_of(scene, {1, 1})]).margin(3e-3 * largest_N));
  const SceneCurve& contacts = curve_of(answer, "contacts");
  CHECK(at(contacts, 0.01) == 12.0);
  CHECK(contacts.value.back() == 16.0);
  // Pillars in the middle hand their load to those that come to bear.
  const SceneCurve& middle = curve_of(answer, "pillar_force_2_2");
  CHECK(middle.value.back() < 0.99 * at(middle, 0.02));
}

// Depth and force as sums of ramps, until the pillar cannot follow.
TEST_CASE("a plane that is lifted faster than a pillar recovers leaves it",
          "[models][array][space]") {
  SpaceScene scene =
      touched(1, 1, plane(), false, {{0.0, 0.0}, {0.1, 2e-6}, {0.5, 2e-6}, {0.6, 0.0}});
  const SceneAnswer answer = simulate(scene);
  const SceneCurve& force = curve_of(answer, "contact_force");
  const SceneCurve& voltage = curve_of(answer, "mean_voltage_1_1");
  const auto ramp_s = [](double t_s) {
    if (t_s <= 0.0) return 0.0;
    return (1.0 - kShare) * t_s + kShare * kTau_s * (1.0 - std::exp(-t_s / kTau_s));
  };
  const double k_N_s = 19.0468 * 2e-6 / 0.1;
  bool is_left = false;
  const double peak_N = *std::max_element(force.value.begin(), force.value.end());
  const double peak_V = largest_size(voltage.value);
  for (std::size_t k = 0; k < force.x.size(); ++k) {
    const double t_s = force.x[k];
    const double followed_N = k_N_s * (ramp_s(t_s) - ramp_s(t_s - 0.1) - ramp_s(t_s - 0.5));
    is_left = is_left || followed_N < 0.0;
    CHECK(force.value[k] == Approx(is_left ? 0.0 : followed_N).margin(1e-4 * peak_N));
    CHECK(std::abs(voltage.value[k] / peak_V) == Approx(force.value[k] / peak_N).margin(1e-6));
  }
  CHECK(is_left);
  CHECK(force.value.back() == 0.0);
  // Maps and single values are those of the largest force, when the plane has come down.
  CHECK(result_of(answer, "contact_force") == Approx(k_N_s * ramp_s(0.1)).epsilon(2e-5));
  CHECK(std::abs(result_of(answer, "mean_voltage_1_1")) == Approx(peak_V).epsilon(1e-12));
}

TEST_CASE("contact that shrinks and comes back is followed step by step",
          "[models][array][space]") {
  for (const bool is_creep : {false, true}) {
    const double high = is_creep ? 110e-6 : 2.2e-6;
    SpaceScene scene = touched(4, 4, paraboloid(20e-3), is_creep,
                               {{0.0, 0.0},
                                {0.05, high},
                                {0.4, high},
                                {0.5, 0.3 * high},
                                {0.8, 0.3 * high},
                                {0.9, 0.8 * high},
                                {1.0, 0.8 * high}});
    scene.pillar.terms = {{0.6, 0.6, kTau_s}};
    press_in_time(scene, *scene.touch);
    scene.wanted = {"depth", "contact_force", "pillar_force_2_2", "pillar_force_1_1"};
    const SceneAnswer answer = simulate(scene);
    const std::vector<SpringStep> springs =
        stepped({mean_gaps_m(scene), 19.0468, 0.6, is_creep, scene.touch->history}, 8000);
    INFO("creep " << is_creep);
    const double deepest_m = largest_size(curve_of(answer, "depth").value);
    const double largest_N = largest_size(curve_of(answer, "pillar_force_2_2").value);
    for (const double time_s : {0.05, 0.4, 0.45, 0.5, 0.6, 0.8, 0.9, 1.0}) {
      INFO(time_s << " s");
      const SpringStep& spring = at(springs, time_s);
      CHECK(at(curve_of(answer, "depth"), time_s) ==
            Approx(spring.depth_m).margin(4e-3 * deepest_m));
      CHECK(at(curve_of(answer, "contact_force"), time_s) ==
            Approx(spring.sum_N).margin(16.0 * 2e-3 * largest_N));
      for (const auto& [name, place] :
           {std::pair{"pillar_force_2_2", RowColumn{2, 2}}, {"pillar_force_1_1", {1, 1}}}) {
        CHECK(at(curve_of(answer, name), time_s) ==
              Approx(spring.force_N[*index_of(scene, place)]).margin(4e-3 * largest_N));
      }
    }
  }
}

// Contact in part of a top, and one maximum of the depth: F(t) = int_0^t1 e(t - s) dF_elastic(s), where the
// contact at t is that at t1 while it grew, int_t1^t e(t - s) d depth(s) = 0 (Ting, J. Appl. Mech. 33
// (1966) 845). Elastic forces are those of a scene at rest.
TEST_CASE("a top touched in part is left as Ting has it", "[models][array][space]") {
  constexpr double kDepth_m = 1e-6, kRise_s = 0.1, kMost = 0.6;
  SpaceScene scene = touched(1, 1, paraboloid(100e-6), false,
                             {{0.0, 0.0}, {kRise_s, kDepth_m}, {2.0 * kRise_s, 0.0}});
  scene.pillar.terms = {{kMost, kMost, kTau_s}};
  scene.tolerance = 1e-2;
  press_in_time(scene, *scene.touch);
  const SceneAnswer answer = simulate(scene);
  const SceneCurve& force = curve_of(answer, "contact_force");
  const SpaceTops tops(scene, 2);
  constexpr int kStates = 400;
  std::vector<double> elastic_N;
  for (int i = 0; i <= kStates; ++i) {
    elastic_N.push_back(tops.at_depth(kDepth_m * i / kStates).pressed.force_N);
  }
  // int_a^b e(t - s) ds
  const auto relaxed_s = [](double from_s, double to_s, double t_s) {
    return (1.0 - kMost) * (to_s - from_s) +
           kMost * kTau_s * (std::exp(-(t_s - to_s) / kTau_s) - std::exp(-(t_s - from_s) / kTau_s));
  };
  const double peak_N = largest_size(force.value);
  for (const double t_s : {0.05, 0.1, 0.12, 0.14, 0.16, 0.18}) {
    double t1_s = t_s;
    if (t_s > kRise_s) {
      const double fallen_s = relaxed_s(kRise_s, t_s, t_s);
      double low_s = 0.0, high_s = kRise_s;
      for (int i = 0; i < 60; ++i) {
        const double middle_s = 0.5 * (low_s + high_s);
        (relaxed_s(middle_s, kRise_s, t_s) > fallen_s ? low_s : high_s) = middle_s;
      }
      t1_s = low_s;
    }
    double expected_N = 0.0;
    for (int i = 0; i < kStates; ++i) {
      const double from_s = kRise_s * i / kStates;
      const double to_s = std::min(kRise_s * (i + 1) / kStates, t1_s);
      if (to_s <= from_s) break;
      const auto state = static_cast<std::size_t>(i);
      expected_N += (elastic_N[state + 1] - elastic_N[state]) * kStates / kRise_s *
                    relaxed_s(from_s, to_s, t_s);
    }
    INFO(t_s << " s");
    CHECK(at(force, t_s) == Approx(expected_N).margin(4e-3 * peak_N));
  }
  CHECK(force.value.back() == 0.0);
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
