// Shapes under which contact grows, shrinks and comes back, beside springs and Ting's solution.
#include "models/array/space/space_contact.h"
#include "models/pillar/time/load_history.h"
#include "tests/models/scene/touches.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

using namespace viscard;
using namespace viscard::test;

namespace {

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
const SpringStep& step_at(const std::vector<SpringStep>& steps, double time_s) {
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

}  // namespace

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
  const double ramp_depth_m = step_at(springs, 0.02).depth_m, depth_m = springs.back().depth_m;
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
    const double high = is_creep ? 140e-6 : 0.6e-6;
    SpaceScene scene = touched(4, 4, paraboloid(100e-3), is_creep,
                               {{0.0, 0.0},
                                {0.05, high},
                                {0.4, high},
                                {0.5, 0.3 * high},
                                {0.8, 0.3 * high},
                                {0.9, 0.8 * high},
                                {1.0, 0.8 * high}});
    scene.pillar.terms = {{0.6, 0.6, kTau_s}};
    scene.tolerance = 1e-2;
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
      const SpringStep& spring = step_at(springs, time_s);
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
  scene.tolerance = 1.5e-2;
  press_in_time(scene, *scene.touch);
  const SceneAnswer answer = simulate(scene);
  const SceneCurve& force = curve_of(answer, "contact_force");
  const SpaceTops tops(scene, 2);
  constexpr int kStates = 120;
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
    CHECK(at(force, t_s) == Approx(expected_N).margin(scene.tolerance * peak_N));
  }
  CHECK(force.value.back() == 0.0);
}
