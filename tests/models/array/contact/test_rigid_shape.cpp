#include "models/array/contact/rigid_shape.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace viscard {
namespace {

TEST_CASE("the heights of shapes", "[models]") {
  const double R_m = 3650e-6;
  const RigidShape cylinder = {.kind = ShapeKind::kCylinder, .radius_m = R_m};
  // R - sqrt(R^2 - x^2): 10 um of depth leave 9.6575, 6.9165, 1.4283 and -6.8196 um.
  const double left_um[] = {9.6575, 6.9165, 1.4283, -6.8196};
  for (int i = 0; i < 4; ++i) {
    CHECK(10.0 - 1e6 * height_m(cylinder, (50.0 + 100.0 * i) * 1e-6, 7e-4) ==
          Approx(left_um[i]).margin(5e-5));
  }
  const RigidShape sphere = {.kind = ShapeKind::kSphere, .x_m = 1e-4, .radius_m = 1e-3};
  CHECK(height_m(sphere, 1e-4 + 6e-4, 8e-4 - 1e-12) == Approx(1e-3).epsilon(1e-4));
  CHECK(std::isinf(height_m(sphere, 1e-4 + 6e-4, 8.1e-4)));
  CHECK(height_m(sphere, 1e-4 + 1e-9, 0.0) == Approx(0.5e-15).epsilon(1e-9));  // no cancellation
  const RigidShape ridge = {
      .kind = ShapeKind::kWedge, .slope = 0.1, .direction_rad = std::numbers::pi / 2.0};
  CHECK(height_m(ridge, 5e-3, -2e-4) == Approx(2e-5));  // the ridge lies along x
  const RigidShape plane = {
      .kind = ShapeKind::kPlane, .y_m = 1e-3, .tilt_x = 0.02, .tilt_y = -0.01};
  CHECK(height_m(plane, 1e-4, 0.0) == Approx(2e-6 + 1e-5));
  const RigidShape edge = {.kind = ShapeKind::kEdge, .x_m = 1e-5};
  CHECK(height_m(edge, 1e-5, 3.0) == 0.0);
  CHECK(std::isinf(height_m(edge, 0.9e-5, 3.0)));
}

TEST_CASE("a table of heights is bilinear and ends at its border", "[models]") {
  const RigidShape shape = {.kind = ShapeKind::kTable,
                            .table = {{0.0, 1.0, 3.0}, {0.0, 2.0}, {0.0, 1.0, 5.0, 2.0, 3.0, 7.0}}};
  validate(shape);
  CHECK(height_m(shape, 0.5, 1.0) == Approx(1.5));
  CHECK(height_m(shape, 2.0, 2.0) == Approx(5.0));
  CHECK(height_m(shape, 3.0, 2.0) == Approx(7.0));
  CHECK(std::isinf(height_m(shape, 3.1, 1.0)));
  CHECK(std::isinf(height_m(shape, 1.0, -0.1)));
}

TEST_CASE("the least height of a shape is a bound", "[models]") {
  RigidShape shapes[] = {
      {.kind = ShapeKind::kPlane},
      {.kind = ShapeKind::kCylinder, .radius_m = 1e-3},
      {.kind = ShapeKind::kSphere, .radius_m = 1e-3},
      {.kind = ShapeKind::kParaboloid, .radius_m = 1e-3},
      {.kind = ShapeKind::kWedge, .slope = 0.3},
      {.kind = ShapeKind::kEdge},
      {.kind = ShapeKind::kTable, .table = {{-1.0, 1.0}, {-1.0, 1.0}, {1.0, 2.0, -3.0, 1.0}}}};
  for (RigidShape& shape : shapes) {
    shape.direction_rad = 0.7;
    shape.tilt_x = 0.05;
    shape.tilt_y = -0.02;
    for (int i = 0; i < 100; ++i) {
      const double x_m = 4e-6 * ((37 * i) % 100 - 50), y_m = 4e-6 * ((71 * i) % 100 - 50);
      const double angle = 0.3 * i, r_m = 2e-5;
      CHECK(least_height_m(shape, x_m, y_m, r_m) <=
            height_m(shape, x_m + r_m * std::cos(angle), y_m + r_m * std::sin(angle)) + 1e-18);
      CHECK(least_height_m(shape, x_m, y_m, r_m) <= height_m(shape, x_m, y_m) + 1e-18);
    }
  }
}

TEST_CASE("shapes without a radius, a slope or heights are refused", "[models]") {
  CHECK_THROWS_AS(validate(RigidShape{.kind = ShapeKind::kSphere}), std::invalid_argument);
  CHECK_THROWS_AS(validate(RigidShape{.kind = ShapeKind::kWedge}), std::invalid_argument);
  CHECK_THROWS_AS(validate(RigidShape{.kind = ShapeKind::kTable,
                                      .table = {{0.0, 0.0}, {0.0, 1.0}, {0, 0, 0, 0}}}),
                  std::invalid_argument);
  CHECK_THROWS_AS(validate(RigidShape{.kind = ShapeKind::kTable,
                                      .table = {{0.0, 1.0}, {0.0, 1.0}, {0.0, NAN, 0.0, 0.0}}}),
                  std::invalid_argument);
}

}  // namespace
}  // namespace viscard
