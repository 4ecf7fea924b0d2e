// Spheres that are small beside the top of a pillar.
#include "models/array/contact/press_array.h"
#include "models/array/contact/round_tip.h"
#include "models/array/contact/top_contact.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace viscard;

namespace {

constexpr double kTop_m = 20e-6, kE_Pa = 1.8e6;

TopContact top_of(double nu, TopFineness fineness, double length_m = 120e-6) {
  return TopContact(top_compliance({.diameter_m = 2.0 * kTop_m, .length_m = length_m},
                                   isotropic_medium(kE_Pa, nu, 965.0), fineness));
}

RigidShape shape_of(ShapeKind kind, double radius_m, double x_m = 0.0, double y_m = 0.0) {
  return {.kind = kind, .x_m = x_m, .y_m = y_m, .radius_m = radius_m, .table = {}};
}

TopPressure pressed(const TopContact& top, const RigidShape& shape, double depth_m) {
  return press_to_depth({{0.0, 0.0, 0.0, 0}}, {top}, shape, depth_m).tops.front();
}

}  // namespace

// Far from the rim and shallow, the whole pillar hardly yields: F = 4/3 E/(1 - nu^2) sqrt(R) delta^1.5.
TEST_CASE("a sphere that is tiny beside a top meets Hertz's half-space", "[models]") {
  const double nu = GENERATE(0.0, 0.33, 0.49, 0.5);
  const TopContact top = top_of(nu, {12, 32}, 50e-6);
  const double R_m = 0.1e-6, depth_m = 1e-12;
  const double hertz_N =
      4.0 / 3.0 * kE_Pa / (1.0 - nu * nu) * std::sqrt(R_m) * std::pow(depth_m, 1.5);
  for (const ShapeKind kind : {ShapeKind::kSphere, ShapeKind::kParaboloid}) {
    const TopPressure found = pressed(top, shape_of(kind, R_m, 3e-6, -2e-6), depth_m);
    CHECK(found.force_N == Approx(hertz_N).epsilon(2e-4));
    CHECK(found.share == Approx(R_m * depth_m / (kTop_m * kTop_m)).epsilon(1e-3));
    CHECK(found.moment_x_Nm == Approx(3e-6 * found.force_N));
    CHECK(found.moment_y_Nm == Approx(-2e-6 * found.force_N));
  }
}

// The grid itself, whose error falls as its spacing, against it where both answer.
TEST_CASE("a small contact passes into one that the points of a top resolve",
          "[models][convergence]") {
  const double x_m = GENERATE(0.0, 5e-6);
  const TopContact coarse = top_of(0.33, {24, 64}), fine = top_of(0.33, {48, 128});
  const RigidShape shape = shape_of(ShapeKind::kParaboloid, 80e-6, x_m);
  const double depth_m = 0.22e-6;  // a contact of about a sixth of the top's radius
  const auto overlap = [&](double x, double y) { return depth_m - height_m(shape, x, y); };
  const double by_tip_N = pressed(fine, shape, depth_m).force_N;
  const double on_fine_N = fine.press(overlap).force_N;
  const double on_coarse_N = coarse.press(overlap).force_N;
  INFO(by_tip_N << " N, on grids " << on_coarse_N << ", " << on_fine_N);
  CHECK(by_tip_N != on_fine_N);
  CHECK(std::abs(by_tip_N / on_fine_N - 1.0) < 0.02);
  CHECK(std::abs(by_tip_N - on_fine_N) < std::abs(by_tip_N - on_coarse_N) + 1e-3 * by_tip_N);
  // The compliance of the rest does not depend on the grid.
  CHECK(pressed(coarse, shape, depth_m).force_N == Approx(by_tip_N).epsilon(2e-3));
}

TEST_CASE("the force of a round tip grows without a step where the grid takes over", "[models]") {
  const TopContact top = top_of(0.33, {24, 64});
  const RigidShape shape = shape_of(ShapeKind::kSphere, 60e-6);
  double last_N = 0.0, steepest = 0.0, flattest = 1e300;
  for (int i = 1; i <= 30; ++i) {
    const double force_N = pressed(top, shape, 0.04e-6 * i).force_N;
    CHECK(force_N > last_N);
    const double share = (force_N - last_N) / std::pow(0.04e-6 * i, 0.5);
    if (i > 3) {
      steepest = std::max(steepest, share);
      flattest = std::min(flattest, share);
    }
    last_N = force_N;
  }
  CHECK(steepest < 3.0 * flattest);
}

TEST_CASE("a force on a small sphere finds the depth that has this force", "[models]") {
  const std::vector<TopContact> classes = {top_of(0.45, {12, 32})};
  const std::vector<TouchedPillar> pillars = {{0.0, 0.0, 0.0, 0}, {100e-6, 0.0, 0.0, 0}};
  for (const double R_m : {0.5e-6, 2e-6, 10e-6}) {
    const RigidShape shape = shape_of(ShapeKind::kSphere, R_m, 104e-6, 1e-6);
    const PressedArray array = press_with_force(pillars, classes, shape, 3e-9);
    CHECK(array.force_N == Approx(3e-9).epsilon(1e-9));
    CHECK(array.contacts == 1);
    CHECK(press_to_depth(pillars, classes, shape, array.depth_m).force_N ==
          Approx(3e-9).epsilon(1e-9));
  }
}

// A sphere curves more than its parabola: Sneddon's closed form of a rigid sphere on a half-space (Int. J. Eng. Sci. 3
// (1965) 47), delta = a/2 ln((R + a)/(R - a)), F = E* [(a^2 + R^2)/2 ln((R + a)/(R - a)) - a R].
TEST_CASE("a deep contact of a tiny sphere is Sneddon's, not that of its parabola", "[models]") {
  const TopContact top = top_of(0.33, {12, 32}, 50e-6);
  const double R_m = 0.02e-6, a_m = 0.4 * R_m;
  const double log_term = std::log((R_m + a_m) / (R_m - a_m));
  const double depth_m = 0.5 * a_m * log_term;
  const double Es_Pa = kE_Pa / (1.0 - 0.33 * 0.33);
  const double sneddon_N = Es_Pa * (0.5 * (a_m * a_m + R_m * R_m) * log_term - a_m * R_m);
  const double found_N = pressed(top, shape_of(ShapeKind::kSphere, R_m), depth_m).force_N;
  CHECK(found_N == Approx(sneddon_N).epsilon(2e-3));
  const double hertz_N = 4.0 / 3.0 * Es_Pa * std::sqrt(R_m) * std::pow(depth_m, 1.5);
  CHECK(std::abs(hertz_N / sneddon_N - 1.0) > 0.01);
}
