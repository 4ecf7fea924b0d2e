#include "models/array/contact/rigid_shape.h"

#include "models/maths/require.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace viscard {
namespace {

constexpr double kNowhere = std::numeric_limits<double>::infinity();

// R - sqrt(R^2 - s^2) without cancellation.
double round_height_m(double radius_m, double s_m) {
  if (std::abs(s_m) >= radius_m) return kNowhere;
  return s_m * s_m / (radius_m + std::sqrt((radius_m - s_m) * (radius_m + s_m)));
}

double table_height_m(const HeightTable& table, double x_m, double y_m) {
  const auto place = [](const std::vector<double>& axis, double at) {
    const auto above = std::upper_bound(axis.begin(), axis.end(), at);
    const std::ptrdiff_t last = static_cast<std::ptrdiff_t>(axis.size()) - 2;
    return std::clamp<std::ptrdiff_t>(above - axis.begin() - 1, 0, last);
  };
  if (x_m < table.x_m.front() || x_m > table.x_m.back() || y_m < table.y_m.front() ||
      y_m > table.y_m.back()) {
    return kNowhere;
  }
  const auto i = static_cast<std::size_t>(place(table.x_m, x_m));
  const auto j = static_cast<std::size_t>(place(table.y_m, y_m));
  const double s = (x_m - table.x_m[i]) / (table.x_m[i + 1] - table.x_m[i]);
  const double t = (y_m - table.y_m[j]) / (table.y_m[j + 1] - table.y_m[j]);
  const auto at = [&](std::size_t column, std::size_t row) {
    return table.height_m[row * table.x_m.size() + column];
  };
  return (1.0 - t) * ((1.0 - s) * at(i, j) + s * at(i + 1, j)) +
         t * ((1.0 - s) * at(i, j + 1) + s * at(i + 1, j + 1));
}

void validate_axis(const std::vector<double>& axis) {
  require(axis.size() >= 2, "a table of heights needs at least two lines along x and along y");
  for (std::size_t i = 1; i < axis.size(); ++i) {
    require(axis[i] > axis[i - 1], "the places of a table of heights must ascend");
  }
}

}  // namespace

void validate(const RigidShape& shape) {
  if (is_round(shape.kind)) require(shape.radius_m > 0.0, "a round shape needs a positive radius");
  if (shape.kind == ShapeKind::kWedge) require(shape.slope > 0.0, "a wedge needs a slope");
  if (shape.kind != ShapeKind::kTable) return;
  validate_axis(shape.table.x_m);
  validate_axis(shape.table.y_m);
  require(shape.table.height_m.size() == shape.table.x_m.size() * shape.table.y_m.size(),
          "a table of heights needs one height for each of its places");
  for (const double height : shape.table.height_m) {
    require(std::isfinite(height), "the heights of a table must be numbers");
  }
}

double height_m(const RigidShape& shape, double x_m, double y_m) {
  const double x = x_m - shape.x_m;
  const double y = y_m - shape.y_m;
  // Across the axis, ridge or edge.
  const double across_m = std::cos(shape.direction_rad) * x + std::sin(shape.direction_rad) * y;
  const double r_m = std::hypot(x, y);
  const double tilted_m = shape.tilt_x * x + shape.tilt_y * y;
  switch (shape.kind) {
    case ShapeKind::kPlane:
      return tilted_m;
    case ShapeKind::kCylinder:
      return tilted_m + round_height_m(shape.radius_m, across_m);
    case ShapeKind::kSphere:
      return tilted_m + round_height_m(shape.radius_m, r_m);
    case ShapeKind::kParaboloid:
      return tilted_m + 0.5 * r_m * r_m / shape.radius_m;
    case ShapeKind::kWedge:
      return tilted_m + shape.slope * std::abs(across_m);
    // The line itself belongs to the half-plane, also when it is rounded.
    case ShapeKind::kEdge:
      return across_m >= -1e-12 * (std::abs(x_m) + std::abs(y_m)) ? tilted_m : kNowhere;
    case ShapeKind::kTable:
      return tilted_m + table_height_m(shape.table, x, y);
  }
  return kNowhere;
}

double least_height_m(const RigidShape& shape, double x_m, double y_m, double r_m) {
  const double x = x_m - shape.x_m;
  const double y = y_m - shape.y_m;
  const double across_m =
      std::abs(std::cos(shape.direction_rad) * x + std::sin(shape.direction_rad) * y);
  const double near_m = std::max(std::hypot(x, y) - r_m, 0.0);
  const double near_across_m = std::max(across_m - r_m, 0.0);
  const double tilted_m =
      shape.tilt_x * x + shape.tilt_y * y - std::hypot(shape.tilt_x, shape.tilt_y) * r_m;
  switch (shape.kind) {
    case ShapeKind::kPlane:
    case ShapeKind::kEdge:
      return tilted_m;
    case ShapeKind::kCylinder:
      return tilted_m + round_height_m(shape.radius_m, near_across_m);
    case ShapeKind::kSphere:
      return tilted_m + round_height_m(shape.radius_m, near_m);
    case ShapeKind::kParaboloid:
      return tilted_m + 0.5 * near_m * near_m / shape.radius_m;
    case ShapeKind::kWedge:
      return tilted_m + shape.slope * near_across_m;
    case ShapeKind::kTable:
      return tilted_m + *std::min_element(shape.table.height_m.begin(), shape.table.height_m.end());
  }
  return -kNowhere;
}

double lowest_node_m(const RigidShape& shape, double x_m, double y_m, double r_m) {
  double lowest_m = kNowhere;
  if (shape.kind != ShapeKind::kTable) return lowest_m;
  const std::vector<double>& xs = shape.table.x_m;
  const std::vector<double>& ys = shape.table.y_m;
  const auto first = [](const std::vector<double>& axis, double at) {
    return static_cast<std::size_t>(std::lower_bound(axis.begin(), axis.end(), at) - axis.begin());
  };
  const double x = x_m - shape.x_m, y = y_m - shape.y_m;
  for (std::size_t j = first(ys, y - r_m); j < ys.size() && ys[j] <= y + r_m; ++j) {
    for (std::size_t i = first(xs, x - r_m); i < xs.size() && xs[i] <= x + r_m; ++i) {
      if (std::hypot(xs[i] - x, ys[j] - y) > r_m) continue;
      lowest_m = std::min(lowest_m, height_m(shape, shape.x_m + xs[i], shape.y_m + ys[j]));
    }
  }
  return lowest_m;
}

double finest_step_m(const RigidShape& shape) {
  double finest_m = kNowhere;
  for (const auto* axis : {&shape.table.x_m, &shape.table.y_m}) {
    for (std::size_t i = 1; i < axis->size(); ++i) {
      finest_m = std::min(finest_m, (*axis)[i] - (*axis)[i - 1]);
    }
  }
  return finest_m;
}

double largest_slope(const RigidShape& shape, double x_m, double y_m, double r_m) {
  constexpr int kDirections = 16;
  const double centre_m = height_m(shape, x_m, y_m);
  double largest = 0.0;
  for (int i = 0; i < kDirections; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kDirections;
    const double at_m = height_m(shape, x_m + r_m * std::cos(angle), y_m + r_m * std::sin(angle));
    largest = std::max(largest, std::abs(at_m - centre_m) / r_m);
  }
  return std::isnan(largest) ? kNowhere : largest;
}

}  // namespace viscard
