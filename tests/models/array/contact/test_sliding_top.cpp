#include "models/array/contact/sliding_top.h"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <numbers>
#include <vector>

namespace viscard {
namespace {

// A pillar of 40 x 120 um, E 1.8 MPa, nu 0.33, on a rigid base, under 10 kPa.
constexpr double kStiffness_N_m = 0.377686, kNormal_N = 12.566e-6;
constexpr double kSpeed_m_s = 1e-4, kShare = 0.3, kTau_s = 0.05;
constexpr double kTurn = 2.0 * std::numbers::pi;

RelaxationStep elastic_step(double) {
  return {};
}

RelaxationStep relaxing_step(double dt_s) {
  const double x = dt_s / kTau_s;
  return {1.0 - kShare, {std::exp(-x)}, {x > 0.0 ? -kShare * std::expm1(-x) / x : kShare}};
}

using Steps = RelaxationStep (*)(double dt_s);

SlidingTop dragged_top(Steps steps) {
  return {kStiffness_N_m, steps(1.0).kept.size()};
}

struct DraggedRamp {
  double begins_s = 0.0, slip_m = 0.0, motion_m = 0.0;
};

// A surface that moves at a speed up to 20 um.
DraggedRamp drag_along(Steps steps, double friction) {
  constexpr int kSteps = 20000;
  constexpr double kStep_s = 0.2 / kSteps;
  SlidingTop top = dragged_top(steps);
  DraggedRamp result;
  for (int i = 1; i <= kSteps; ++i) {
    top.drag(steps(kStep_s), {kSpeed_m_s * kStep_s, 0.0}, friction * kNormal_N);
    if (result.begins_s == 0.0 && top.slides()) result.begins_s = i * kStep_s;
  }
  result.slip_m = top.slip_m();
  result.motion_m = top.motion_m().x();
  return result;
}

struct Cycle {
  double loss_J = 0.0, slip_m = 0.0;
  std::complex<double> ratio;  // of force over k times the way
};

// The sixth cycle of a surface that goes to and fro by 20 um.
Cycle sixth_cycle(Steps steps, double frequency_Hz, double limit_N) {
  constexpr int kSteps = 4000, kCycles = 6;
  constexpr double kWay_m = 20e-6;
  SlidingTop top = dragged_top(steps);
  Cycle cycle;
  double slip_before_m = 0.0;
  for (int i = 1; i <= kCycles * kSteps; ++i) {
    if (i == (kCycles - 1) * kSteps + 1) slip_before_m = top.slip_m();
    const double before_m = kWay_m * std::sin(kTurn * (i - 1) / kSteps);
    const double way_m = kWay_m * std::sin(kTurn * i / kSteps) - before_m;
    const double before_N = top.force_N().x();
    top.drag(steps(1.0 / (frequency_Hz * kSteps)), {way_m, 0.0}, limit_N);
    if (i <= (kCycles - 1) * kSteps) continue;
    cycle.loss_J += 0.5 * (before_N + top.force_N().x()) * way_m;
    cycle.ratio += top.force_N().x() * std::polar(2.0 / kSteps, -kTurn * i / kSteps);
  }
  cycle.slip_m = top.slip_m() - slip_before_m;
  cycle.ratio *= std::complex<double>(0.0, 1.0) / (kStiffness_N_m * kWay_m);
  return cycle;
}

// Numbers between -1 and 1 that look like noise.
double some_number(int i, double seed) {
  return std::sin(seed + 12.9898 * i + 1e-3 * i * i);
}

}  // namespace

TEST_CASE("a top sticks until Coulomb's limit and slides then, elastic and relaxing",
          "[models][reduction]") {
  for (const double friction : {0.1, 0.3}) {
    const double at_m = friction * kNormal_N / kStiffness_N_m;
    const DraggedRamp elastic = drag_along(elastic_step, friction);
    CHECK(elastic.begins_s * kSpeed_m_s == Approx(at_m).margin(1.1e-9));
    CHECK(elastic.slip_m == Approx(20e-6 - at_m).epsilon(1e-9));
  }
  CHECK(drag_along(elastic_step, 0.1).begins_s == Approx(3.32710e-2).margin(1.1e-5));
  CHECK(drag_along(elastic_step, 0.3).begins_s == Approx(9.98131e-2).margin(1.1e-5));
  // k v [(1 - g) t + g tau (1 - exp(-t/tau))] = mu N
  CHECK(drag_along(relaxing_step, 0.1).begins_s == Approx(0.036440).margin(1.1e-5));
  CHECK(drag_along(relaxing_step, 0.3).begins_s == Approx(0.122993).margin(1.1e-5));
  CHECK(drag_along(relaxing_step, 0.1).slip_m == Approx(15.3593e-6).epsilon(1e-5));
  CHECK(drag_along(relaxing_step, 0.3).slip_m == Approx(6.4078e-6).epsilon(1e-5));
  CHECK(drag_along(relaxing_step, 0.0).slip_m == Approx(20e-6).epsilon(1e-12));
  CHECK(drag_along(relaxing_step, HUGE_VAL).slip_m == 0.0);
}

TEST_CASE("a top that slides under a constant force creeps on to mu N/(k (1 - g))",
          "[models][reduction]") {
  SlidingTop top = dragged_top(relaxing_step);
  const double limit_N = 0.1 * kNormal_N;
  for (int i = 0; i < 4000; ++i) top.drag(relaxing_step(1e-3), {1e-7, 0.0}, limit_N);
  CHECK(top.force_N().x() == Approx(limit_N).epsilon(1e-12));
  CHECK(top.motion_m().x() == Approx(limit_N / (kStiffness_N_m * (1.0 - kShare))).epsilon(1e-9));
}

TEST_CASE("a surface that goes to and fro loses the work of friction and of the chains",
          "[models][reduction]") {
  const double limit_N = 0.3 * kNormal_N;
  for (const double frequency_Hz : {0.5, 3.183099, 50.0}) {
    const Cycle elastic = sixth_cycle(elastic_step, frequency_Hz, limit_N);
    const double closed_J = 4.0 * limit_N * (20e-6 - limit_N / kStiffness_N_m);
    CHECK(closed_J == Approx(1.51074e-10).epsilon(1e-5));
    CHECK(elastic.loss_J == Approx(closed_J).epsilon(1e-5));
    CHECK(elastic.slip_m == Approx(40.0748e-6).epsilon(1e-5));
  }
  struct Row {
    double frequency_Hz, loss_J, slip_m, size, phase_degree;
  };
  for (const Row& row : {Row{0.5, 1.02024e-10, 22.9886e-6, 0.708718, 3.7206},
                         Row{3.183099, 1.47815e-10, 30.3036e-6, 0.863134, 10.0080},
                         Row{50.0, 1.52570e-10, 39.6042e-6, 0.998970, 1.0910}}) {
    const Cycle slid = sixth_cycle(relaxing_step, row.frequency_Hz, limit_N);
    CHECK(slid.loss_J == Approx(row.loss_J).epsilon(1e-5));
    CHECK(slid.slip_m == Approx(row.slip_m).epsilon(1e-5));
    // Where it sticks: k*(w)/k = 1 - g/(1 + i w tau), up to what is left of the start after five cycles.
    const Cycle stuck = sixth_cycle(relaxing_step, row.frequency_Hz, HUGE_VAL);
    const double left = 0.2 * std::exp(-5.0 / (row.frequency_Hz * kTau_s));
    CHECK(std::abs(stuck.ratio) == Approx(row.size).margin(2e-6 + left));
    CHECK(360.0 / kTurn * std::arg(stuck.ratio) ==
          Approx(row.phase_degree).margin(2e-3 + 60.0 * left));
  }
}

TEST_CASE(
    "along any path the force stays within the limit, turns with the path and creates no energy",
    "[models][reduction]") {
  const Eigen::Rotation2D<double> turned(0.7);
  SlidingTop top = dragged_top(relaxing_step), other = dragged_top(relaxing_step),
             mirrored = dragged_top(relaxing_step);
  Eigen::Vector2d speed_m = Eigen::Vector2d::Zero();
  double work_J = 0.0, rubbed_J = 0.0, least_J = 0.0;
  for (int i = 1; i <= 20000; ++i) {
    speed_m += 1e-10 * Eigen::Vector2d(some_number(i, 0.3), some_number(i, 1.7)) - 1e-3 * speed_m;
    const Eigen::Vector2d way_m =
        speed_m + 2e-8 * Eigen::Vector2d(std::sin(2e-3 * i), std::cos(3e-3 * i));
    const double limit_N = 0.3 * kNormal_N * std::max(0.0, 0.6 + 0.8 * std::sin(5e-3 * i));
    const RelaxationStep step = relaxing_step(1e-4);
    const Eigen::Vector2d before_N = top.force_N();
    const double before_m = top.slip_m();
    if (limit_N > 0.0) {
      top.drag(step, way_m, limit_N);
      other.drag(step, turned * way_m, limit_N);
      mirrored.drag(step, -way_m, limit_N);
    } else {
      top.leave(step);
      other.leave(step);
      mirrored.leave(step);
      CHECK(top.force_N().norm() == 0.0);
    }
    REQUIRE(top.force_N().norm() <= limit_N * (1.0 + 1e-12));
    REQUIRE((other.force_N() - turned * top.force_N()).norm() <= 1e-9 * kNormal_N);
    REQUIRE((mirrored.force_N() + top.force_N()).norm() <= 1e-12 * kNormal_N);
    REQUIRE(top.slip_m() >= before_m);
    if (limit_N > 0.0) work_J += 0.5 * (before_N + top.force_N()).dot(way_m);
    rubbed_J += top.force_N().norm() * (top.slip_m() - before_m);
    least_J = std::min(least_J, work_J - rubbed_J);
  }
  CHECK(rubbed_J > 0.2 * work_J);
  CHECK(rubbed_J < work_J);
  CHECK(least_J > -1e-4 * work_J);  // the rest of the work is stored or lost in the chains
}

TEST_CASE(
    "a top that is left moves to its rest without slip and starts afresh when it is touched again",
    "[models][reduction]") {
  SlidingTop top = dragged_top(relaxing_step);
  top.drag(relaxing_step(1.0), {5e-6, 0.0}, HUGE_VAL);
  top.leave(relaxing_step(0.0));
  CHECK(top.force_N().norm() == 0.0);
  CHECK(top.motion_m().x() > 0.1e-6);  // what the chains still hold
  for (int i = 0; i < 100; ++i) top.leave(relaxing_step(0.02));
  CHECK(std::abs(top.motion_m().x()) < 1e-12);
  CHECK(top.slip_m() == 0.0);
  top.drag(relaxing_step(0.0), {0.0, -2e-6}, HUGE_VAL);
  CHECK(top.force_N().y() == Approx(-2e-6 * kStiffness_N_m).epsilon(1e-6));
  SlidingTop elastic = dragged_top(elastic_step);
  elastic.drag({}, {5e-6, 0.0}, HUGE_VAL);
  elastic.leave({});
  CHECK(elastic.motion_m().norm() < 1e-20);
}

}  // namespace viscard
