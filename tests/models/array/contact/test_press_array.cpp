#include "models/array/contact/press_array.h"
#include "models/pillar/system/medium.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace viscard {
namespace {

constexpr double kUm = 1e-6;

// Pillars of 40 x 120 um, E 1.8 MPa, nu 0.33. A graded mesh of degree 12 on a film of PVDF: a uniform
// pressure sinks the top by 6.59763e-11 m/Pa, and t_z = x/R turns it by 3.3061e-6 rad/Pa.
TopContact usual_contact(double scale = 1.0) {
  const double R_m = 20.0 * kUm;
  const double area_m2 = std::numbers::pi * R_m * R_m;
  TopCompliance top =
      top_compliance(PillarGeometry{.diameter_m = 40.0 * kUm, .length_m = 120.0 * kUm},
                     isotropic_medium(scale * 1.8e6, 0.33, 965.0), {.elements = 8, .angles = 24});
  top.adjust(6.59763e-11 / area_m2 / scale, 3.3061e-6 / (0.25 * area_m2 * R_m) / scale);
  return TopContact(top);
}

std::vector<TouchedPillar> square(int count, double pitch_m = 100.0 * kUm) {
  std::vector<TouchedPillar> pillars;
  for (int row = 0; row < count; ++row) {
    for (int column = 0; column < count; ++column) {
      pillars.push_back(
          {(column - 0.5 * (count - 1)) * pitch_m, (row - 0.5 * (count - 1)) * pitch_m});
    }
  }
  return pillars;
}

RigidShape paraboloid(double radius_m) {
  return {.kind = ShapeKind::kParaboloid, .radius_m = radius_m};
}

TEST_CASE("a paraboloid on 8 x 8 pillars bears the mean overlap of each", "[models]") {
  const PressedArray array =
      press_to_depth(square(8), {usual_contact()}, paraboloid(3650.0 * kUm), 10.0 * kUm);
  CHECK(array.contacts == 24);
  // F = k (delta - (r^2 + R^2/2)/(2 R_shape)), k = 19.0468 N/m.
  CHECK(array.tops[3 * 8 + 4].force_N == Approx(176.900e-6).epsilon(1e-5));
  CHECK(array.tops[3 * 8 + 5].force_N == Approx(124.717e-6).epsilon(1e-5));
  CHECK(array.tops[2 * 8 + 5].force_N == Approx(72.534e-6).epsilon(1e-5));
  // One side of the outer ones lifts: more force than the mean overlap's 20.351 uN, which pulls there.
  const TopPressure& outer = array.tops[3 * 8 + 6];
  CHECK(outer.is_partial);
  CHECK(outer.force_N > 20.351e-6);
  CHECK(outer.force_N < 1.006 * 20.351e-6);
  CHECK(outer.moment_x_Nm < 0.0);  // pressed on its inner side
  CHECK(array.force_N == Approx(2.158289e-3).epsilon(1e-3));
}

TEST_CASE("many pillars under a wide paraboloid are an elastic foundation", "[models]") {
  const double R_m = 0.1, depth_m = kUm, pitch_m = 100.0 * kUm;
  const PressedArray array =
      press_to_depth(square(100), {usual_contact()}, paraboloid(R_m), depth_m);
  // Tops whose nearest point lies below the surface; on 60 of them the mean overlap is positive, and its
  // sum is 5.961647e-4 N. The other eight are touched at their rim alone.
  int reached = 0;
  for (const TouchedPillar& one : square(100)) {
    const double near_m = std::hypot(one.x_m, one.y_m) - 20.0 * kUm;
    if (near_m * near_m < 2.0 * R_m * depth_m) ++reached;
  }
  CHECK(reached == 68);
  CHECK(array.contacts == reached);
  CHECK(array.force_N > 5.961647e-4);
  CHECK(array.force_N == Approx(5.961647e-4).epsilon(1e-3));
  const double k_N_m = 19.0468;
  CHECK(array.force_N ==
        Approx(std::numbers::pi * k_N_m * R_m * depth_m * depth_m / (pitch_m * pitch_m))
            .epsilon(5e-3));
}

// 188 tops whose mean overlap is positive bear 5.37716e-3 N, the most loaded 45.08 kPa (mean-gap law).
TEST_CASE("a paraboloid at a depth of 3 um on 100 x 100 pillars bears as the mean-gap law says",
          "[models]") {
  const PressedArray array =
      press_to_depth(square(100), {usual_contact()}, paraboloid(0.1), 3.0 * kUm);
  int pressed = 0;
  double most_N = 0.0;
  for (const TouchedPillar& one : square(100)) {
    const double mean_m = 3.0 * kUm - (one.x_m * one.x_m + one.y_m * one.y_m + 2e-10) / (2.0 * 0.1);
    pressed += mean_m > 0.0 ? 1 : 0;
  }
  for (const TopPressure& top : array.tops) most_N = std::max(most_N, top.force_N);
  CHECK(pressed == 188);
  CHECK(array.contacts >= pressed);
  CHECK(array.force_N == Approx(5.37716e-3).epsilon(1e-3));
  CHECK(most_N / (std::numbers::pi * 400e-12) == Approx(45.08e3).epsilon(2e-4));
}

TEST_CASE("the force of a depth leads back to the depth", "[models][stability]") {
  const std::vector<TopContact> classes = {usual_contact()};
  const RigidShape shapes[] = {
      paraboloid(3650.0 * kUm),
      {.kind = ShapeKind::kSphere, .x_m = 31.0 * kUm, .radius_m = 400.0 * kUm},
      {.kind = ShapeKind::kCylinder, .radius_m = 300.0 * kUm, .direction_rad = 0.4},
      {.kind = ShapeKind::kWedge, .slope = 0.05, .direction_rad = 1.0},
      {.kind = ShapeKind::kPlane, .tilt_x = 0.01, .tilt_y = -0.003}};
  for (const RigidShape& shape : shapes) {
    for (const double depth_m : {1e-9, 0.4 * kUm, 5.0 * kUm}) {
      const PressedArray by_depth = press_to_depth(square(4), classes, shape, depth_m);
      INFO("shape " << static_cast<int>(shape.kind) << ", depth " << depth_m);
      if (by_depth.force_N == 0.0) continue;
      const PressedArray by_force = press_with_force(square(4), classes, shape, by_depth.force_N);
      CHECK(by_force.force_N == Approx(by_depth.force_N).epsilon(1e-10));
      CHECK(by_force.depth_m == Approx(depth_m).epsilon(1e-9));
    }
  }
}

TEST_CASE("a symmetric array under a symmetric shape answers symmetrically",
          "[models][stability]") {
  const PressedArray array =
      press_to_depth(square(6), {usual_contact()}, paraboloid(800.0 * kUm), 9.0 * kUm);
  for (int row = 0; row < 6; ++row) {
    for (int column = 0; column < 6; ++column) {
      const auto at = [&](int r, int c) { return array.tops[static_cast<std::size_t>(6 * r + c)]; };
      CHECK(at(row, column).force_N == Approx(at(column, row).force_N).margin(1e-13));
      CHECK(at(row, column).force_N == Approx(at(row, 5 - column).force_N).margin(1e-13));
      CHECK(at(row, column).moment_x_Nm == Approx(-at(row, 5 - column).moment_x_Nm).margin(1e-18));
      CHECK(at(row, column).moment_x_Nm == Approx(at(column, row).moment_y_Nm).margin(1e-18));
    }
  }
}

TEST_CASE("forces scale with the modulus, and a longer pillar is touched first", "[models]") {
  const RigidShape shape = paraboloid(500.0 * kUm);
  const double soft_N = press_to_depth(square(3), {usual_contact()}, shape, 3.0 * kUm).force_N;
  const double stiff_N = press_to_depth(square(3), {usual_contact(1e3)}, shape, 3.0 * kUm).force_N;
  CHECK(stiff_N == Approx(1e3 * soft_N).epsilon(1e-9));
  std::vector<TouchedPillar> pillars = square(3);
  pillars[0].above_m = 2.0 * kUm;
  const PressedArray array =
      press_to_depth(pillars, {usual_contact()}, {.kind = ShapeKind::kPlane}, -0.5 * kUm);
  CHECK(array.contacts == 1);
  CHECK(array.tops[0].force_N == Approx(19.0468 * 1.5e-6).epsilon(1e-5));
}

TEST_CASE("a shape that touches nothing gives zeros, and no force without pillars",
          "[models][stability]") {
  const std::vector<TopContact> classes = {usual_contact()};
  const RigidShape sphere = {.kind = ShapeKind::kSphere, .x_m = 1.0, .radius_m = 1e-3};
  const PressedArray array = press_to_depth(square(3), classes, sphere, 1e-6);
  CHECK(array.contacts == 0);
  CHECK(array.force_N == 0.0);
  CHECK_THROWS_AS(press_with_force(square(3), classes, sphere, 1e-6), std::invalid_argument);
  CHECK_THROWS_AS(press_with_force(square(3), classes, paraboloid(1e-3), 0.0),
                  std::invalid_argument);
}

TEST_CASE("an edge on the very edge of a top touches the top or does not", "[models][stability]") {
  const std::vector<TopContact> classes = {usual_contact()};
  for (const double x_m : {-20.0 * kUm, 20.0 * kUm}) {
    const RigidShape edge = {.kind = ShapeKind::kEdge, .x_m = x_m};
    const PressedArray array = press_to_depth({{}}, classes, edge, kUm);
    INFO("edge at " << x_m);
    CHECK(array.force_N >= 0.0);
    CHECK(array.force_N <= 19.0468e-6 * (1.0 + 1e-5));
    const double whole_N = kUm / classes[0].compliance().sinking_m_N();
    if (x_m < 0.0) CHECK(array.force_N == Approx(whole_N).epsilon(1e-9));
  }
}

}  // namespace
}  // namespace viscard
