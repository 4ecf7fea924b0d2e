// Shapes that move over arrays: forces, shears and slips beside springs that are stepped one by one.
#include "models/answer/scene_mistake.h"
#include "models/array/space/simulate_space.h"
#include "models/array/space/touch_steps.h"
#include "tests/models/array/space/film_of_the_thesis.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace viscard {
namespace {

constexpr double kAxial_N_m = 19.0468, kLateral_N_m = 0.377686;  // of 40 x 120 um, E 1.8 MPa
constexpr double kLost = 0.3, kRelaxing_s = 0.05;                // of the only term

struct Stop {
  double time_s, x_m, y_m, depth_m;
};
using Path = std::vector<Stop>;

SpaceScene scanned(int side, const RigidShape& shape, double friction, const Path& path,
                   double lost = kLost) {
  SpaceScene scene;
  scene.pillar.E0_Pa = 1.8e6;
  scene.pillar.nu = 0.33;
  scene.pillar.rho_kg_m3 = 965.0;
  if (lost > 0.0) scene.pillar.terms = {{lost, lost, kRelaxing_s}};
  scene.film = test::pvdf_of_the_thesis();
  scene.rows = scene.columns = side;
  scene.pillars = lattice_places(SpaceLattice::kSquare, side, side, 100e-6);
  scene.film_edge_m = 300e-6;
  scene.tolerance = 5e-3;
  scene.press = ShapePress{.shape = shape};
  scene.press->friction = friction > 0.0 ? Friction::kCoulomb : Friction::kNone;
  scene.press->friction_coefficient = friction;
  SpaceTouch touch;
  for (const Stop& stop : path) {
    touch.history.push_back({stop.time_s, stop.depth_m});
    touch.place_m.emplace_back(stop.x_m, stop.y_m);
  }
  press_in_time(scene, touch);
  scene.wanted = {"pillar_force", "contact_force", "mean_voltage"};
  if (friction > 0.0) {
    for (const char* name : {"shear_force_x", "shear_force_y", "slip", "largest_slip",
                             "sliding_tops", "sticking_tops"}) {
      scene.wanted.emplace_back(name);
    }
  }
  return scene;
}

RigidShape round_shape(double radius_m) {
  return {.kind = ShapeKind::kParaboloid, .radius_m = radius_m, .table = {}};
}

const SceneCurve& course_of(const SceneAnswer& answer, const std::string& name) {
  for (const SceneCurve& one : answer.curves) {
    if (one.name == name) return one;
  }
  throw std::runtime_error("no curve " + name);
}

// A column and a bending spring with one Maxwell branch each, under the mean height of a paraboloid over
// a top that it covers everywhere.
struct Spring {
  double normal_N = 0.0, slip_m = 0.0;
  double shear_N[2] = {0.0, 0.0};
  double way_m = 0.0, branch_m = 0.0, sideways_m[2] = {0.0, 0.0}, of_sideways_m[2] = {0.0, 0.0};
};
void step_spring(const Stop& before, const Stop& now, double radius_m, double friction,
                 const SpacePillar& one, Spring& s) {
  constexpr double kTop_m2 = 20e-6 * 20e-6;
  const double x = (now.time_s - before.time_s) / kRelaxing_s, kept = std::exp(-x);
  const double gained = kLost * (1.0 - kept) / x, factor = 1.0 - kLost + gained;
  const double gap_m =
      (std::pow(one.x_m - now.x_m, 2) + std::pow(one.y_m - now.y_m, 2) + 0.5 * kTop_m2) /
      (2.0 * radius_m);
  const double carried_m = kept * s.branch_m - gained * s.way_m;
  s.normal_N = std::max(kAxial_N_m * (factor * (now.depth_m - gap_m) + carried_m), 0.0);
  const double next_m = (s.normal_N / kAxial_N_m - carried_m) / factor;
  s.branch_m = kept * s.branch_m + gained * (next_m - s.way_m);
  s.way_m = next_m;
  const double ways_m[2] = {now.x_m - before.x_m, now.y_m - before.y_m};
  double trial_N[2], of_step_m[2], slipped_m[2];
  for (int a = 0; a < 2; ++a) {
    of_step_m[a] = kept * s.of_sideways_m[a] - gained * s.sideways_m[a];
    trial_N[a] = kLateral_N_m * (factor * (s.sideways_m[a] + ways_m[a]) + of_step_m[a]);
  }
  const double size_N = std::hypot(trial_N[0], trial_N[1]);
  const double share = std::min(1.0, friction * s.normal_N / size_N);
  for (int a = 0; a < 2; ++a) {
    s.shear_N[a] = size_N > 0.0 ? share * trial_N[a] : 0.0;
    const double moved_m = (s.shear_N[a] / kLateral_N_m - of_step_m[a]) / factor;
    slipped_m[a] = s.sideways_m[a] + ways_m[a] - moved_m;
    s.of_sideways_m[a] = kept * s.of_sideways_m[a] + gained * (moved_m - s.sideways_m[a]);
    s.sideways_m[a] = moved_m;
  }
  if (s.normal_N > 0.0) s.slip_m += std::hypot(slipped_m[0], slipped_m[1]);
}

Stop stop_at(const Path& path, double time_s) {
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Stop &a = path[i - 1], &b = path[i];
    if (time_s > b.time_s) continue;
    const double s = (time_s - a.time_s) / (b.time_s - a.time_s);
    return {time_s, a.x_m + s * (b.x_m - a.x_m), a.y_m + s * (b.y_m - a.y_m),
            a.depth_m + s * (b.depth_m - a.depth_m)};
  }
  return path.back();
}

}  // namespace

TEST_CASE("a sphere that is moved over an array drags each top as a pillar of its own",
          "[models][array][space]") {
  constexpr double kRadius_m = 200e-3, kFriction = 0.3;
  const Path path = {{0.0, -60e-6, 0.0, 1.6e-6},
                     {0.1, -50e-6, 10e-6, 1.5e-6},
                     {0.3, 60e-6, 20e-6, 1.5e-6},
                     {0.4, 40e-6, 20e-6, 1.2e-6}};
  const SpaceScene scene = scanned(3, round_shape(kRadius_m), kFriction, path);
  const SceneAnswer answer = simulate_space(scene);
  const std::vector<double>& time_s = course_of(answer, "sliding_tops").x;
  double largest_N = 0.0, largest_slip_m = 0.0;
  std::vector<double> sliding(time_s.size(), 0.0);
  for (const SpacePillar& one : scene.pillars) {
    const std::string ending = "_" + std::to_string(one.row) + "_" + std::to_string(one.column);
    const SceneCurve& normal = course_of(answer, "pillar_force" + ending);
    const SceneCurve& shear_x = course_of(answer, "shear_force_x" + ending);
    const SceneCurve& shear_y = course_of(answer, "shear_force_y" + ending);
    const SceneCurve& slip = course_of(answer, "slip" + ending);
    constexpr double kStep_s = 2e-5;
    Spring spring;
    Stop before = path.front();
    step_spring({-1e-9, before.x_m, before.y_m, 0.0}, before, kRadius_m, kFriction, one, spring);
    std::size_t k = 1;  // the first sample is before the shape lands
    for (int i = 1; k < time_s.size(); ++i) {
      for (; k < time_s.size() && time_s[k] < (i - 0.5) * kStep_s; ++k) {
        INFO("at " << time_s[k] << " s" << ending);
        CHECK(normal.value[k] == Approx(spring.normal_N).margin(6e-3 * 30e-6));
        CHECK(shear_x.value[k] == Approx(spring.shear_N[0]).margin(4e-3 * 9e-6));
        CHECK(shear_y.value[k] == Approx(spring.shear_N[1]).margin(4e-3 * 9e-6));
        CHECK(slip.value[k] == Approx(spring.slip_m).margin(0.1e-6));
        // Where it begins to slide between two samples, a straight line to the next one is wrong.
        if (shear_x.value[k] != 0.0) CHECK(shear_x.error[k] > 0.0);
        CHECK(std::hypot(shear_x.value[k], shear_y.value[k]) <=
              kFriction * normal.value[k] * (1.0 + 1e-9));
        largest_N = std::max(largest_N, normal.value[k]);
        largest_slip_m = std::max(largest_slip_m, slip.value[k]);
      }
      const Stop now = stop_at(path, i * kStep_s);
      step_spring(before, {i * kStep_s, now.x_m, now.y_m, now.depth_m}, kRadius_m, kFriction, one,
                  spring);
      before = now;
      before.time_s = i * kStep_s;
    }
  }
  CHECK(largest_N == Approx(30e-6).epsilon(0.1));
  CHECK(largest_slip_m > 50e-6);
  const SceneCurve& largest = course_of(answer, "largest_slip");
  CHECK(largest.value.back() == Approx(largest_slip_m).epsilon(1e-12));
  // It sticks at first, slides on the way, and sticks again after the turn.
  const SceneCurve& sticking = course_of(answer, "sticking_tops");
  CHECK(sticking.value[1] == 9.0);
  CHECK(*std::min_element(sticking.value.begin() + 1, sticking.value.end()) == 0.0);
}

TEST_CASE("a shape that moves the other way shears an array the other way",
          "[models][array][space]") {
  const Path there = {{0.0, -30e-6, 0.0, 1e-6}, {0.2, 30e-6, 0.0, 1e-6}};
  Path back = there;
  for (Stop& stop : back) stop.x_m = -stop.x_m;
  const SceneAnswer a = simulate_space(scanned(2, round_shape(50e-3), 0.2, there));
  const SceneAnswer b = simulate_space(scanned(2, round_shape(50e-3), 0.2, back));
  const SceneCurve& left = course_of(a, "shear_force_x_1_1");
  const SceneCurve& right = course_of(b, "shear_force_x_1_2");
  REQUIRE(left.value.size() == right.value.size());
  CHECK(left.value.back() > 1e-6);
  for (std::size_t k = 0; k < left.value.size(); ++k) {
    CHECK(left.value[k] == Approx(-right.value[k]).margin(1e-12));
  }
}

TEST_CASE(
    "a ridged surface that is scanned presses with the mean over a top and the lag of the pillar",
    "[models][array][space]") {
  constexpr double kWave_m = 200e-6, kHeight_m = 0.2e-6, kSpeed_m_s = 2e-3, kDepth_m = 1e-6;
  RigidShape ridges{.kind = ShapeKind::kTable, .table = {}};
  HeightTable& table = ridges.table;
  for (int i = 0; i <= 400; ++i) table.x_m.push_back((i - 380) * 2.5e-6);
  table.y_m = {-50e-6, 50e-6};
  for (int row = 0; row < 2; ++row) {
    for (const double x_m : table.x_m) {
      table.height_m.push_back(kHeight_m *
                               (1.0 + std::cos(2.0 * std::numbers::pi * x_m / kWave_m)));
    }
  }
  SpaceScene scene =
      scanned(1, ridges, 0.0, {{0.0, 0.0, 0.0, kDepth_m}, {0.4, 0.4 * kSpeed_m_s, 0.0, kDepth_m}});
  scene.tolerance = 1e-2;
  const SceneAnswer answer = simulate_space(scene);
  const SceneCurve& force = course_of(answer, "pillar_force_1_1");
  const SceneCurve& voltage = course_of(answer, "mean_voltage_1_1");
  const double omega = 2.0 * std::numbers::pi * kSpeed_m_s / kWave_m;
  const double q = 2.0 * std::numbers::pi * 20e-6 / kWave_m;
  const double mean_over_top = 2.0 * std::cyl_bessel_j(1.0, q) / q;
  const std::complex<double> relaxed =
      1.0 - kLost / (1.0 + std::complex<double>(0.0, omega * kRelaxing_s));
  for (std::size_t k = 0; k < force.x.size(); ++k) {
    const double t_s = force.x[k];
    if (t_s < 0.35) continue;  // seven relaxation times: what is left of the start is 3e-4 of it
    const double ripple_m =
        -kHeight_m * mean_over_top * (relaxed * std::polar(1.0, omega * t_s)).real();
    const double expected_N = kAxial_N_m * ((1.0 - kLost) * (kDepth_m - kHeight_m) + ripple_m);
    CHECK(force.value[k] == Approx(expected_N).epsilon(4e-3));
    // 1.92397 mV/kPa of the mean over the disc, film of the isotropic kind; here only the ratio.
    CHECK(voltage.value[k] / voltage.value.back() ==
          Approx(force.value[k] / force.value.back()).epsilon(1e-3));
  }
}

TEST_CASE("on elastic pillars a shape that moves presses as one that is put there at rest",
          "[models][array][space]") {
  const Path path = {{0.0, -80e-6, 0.0, 0.3e-6}, {1.0, 40e-6, 0.0, 0.8e-6}};
  const SceneAnswer moved = simulate_space(scanned(2, round_shape(10e-3), 0.0, path, 0.0));
  SpaceScene rest = scanned(2, round_shape(10e-3), 0.0, path, 0.0);
  rest.touch.reset();
  rest.press->shape.x_m = 40e-6;
  rest.press->depth_m = 0.8e-6;
  const SceneAnswer still = simulate_space(rest);
  for (const SceneResult& one : still.results) {
    if (!one.name.starts_with("pillar_force_")) continue;
    if (one.name.ends_with("est")) continue;
    CHECK(course_of(moved, one.name).value.back() == Approx(one.value).margin(5e-3 * 15e-6));
  }
}

TEST_CASE("a path that makes no sense is refused by its key", "[models][array][space]") {
  const auto key_of = [](double friction, const Path& path) {
    try {
      validate(scanned(1, round_shape(10e-3), friction, path));
    } catch (const SceneMistake& mistake) {
      return mistake.key();
    }
    return std::string("none");
  };
  CHECK(key_of(0.3, {{0.0, 0.0, 0.0, 1e-6}, {1.0, 1e-6, 0.0, 1e-6}}) == "none");
  CHECK(key_of(0.3, {{0.0, 0.0, 0.0, 1e-6}}) == "shape.path");
  CHECK(key_of(0.3, {{0.0, 0.0, 0.0, 1e-6}, {0.0, 1e-6, 0.0, 1e-6}, {1.0, 1e-6, 0.0, 1e-6}}) ==
        "shape.path.2");
  CHECK(key_of(0.3, {{0.0, 0.0, 0.0, -1e-6}, {1.0, 1e-6, 0.0, -1e-6}}) == "shape.path");
  CHECK(key_of(0.3, {{0.0, 0.0, 0.0, 1e-6}, {1.0, 10.0, 0.0, 1e-6}}) == "shape.path");
  SpaceScene at_rest =
      scanned(1, round_shape(10e-3), 0.3, {{0.0, 0.0, 0.0, 1e-6}, {1.0, 1e-6, 0.0, 1e-6}});
  at_rest.touch.reset();
  CHECK_THROWS_AS(validate(at_rest), SceneMistake);
}

}  // namespace viscard
