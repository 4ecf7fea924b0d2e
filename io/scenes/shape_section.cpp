#include "io/scenes/shape_section.h"

#include "io/scenes/pillar_positions.h"
#include "io/scenes/scene_words.h"
#include "models/pillar/mesh/scene_mistake.h"

#include <cmath>
#include <numbers>
#include <tuple>

namespace viscard {
namespace {

bool is_round(ShapeKind kind) {
  return kind == ShapeKind::kCylinder || kind == ShapeKind::kSphere ||
         kind == ShapeKind::kParaboloid;
}

std::pair<double, double> pair_of(const char* key, const std::vector<double>& values) {
  if (values.empty()) return {0.0, 0.0};
  if (values.size() != 2) {
    throw SceneMistake(std::string("shape.") + key, "needs two values, along x and along y");
  }
  return {values[0], values[1]};
}

// Keys that another kind of shape has.
void refuse_strangers(const RawShape& raw, ShapeKind kind) {
  if (raw.radius_m > 0.0 && !is_round(kind)) {
    throw SceneMistake("shape.radius", "belongs to a cylinder, a sphere or a paraboloid");
  }
  if (raw.angle_rad != 0.0 && kind != ShapeKind::kWedge) {
    throw SceneMistake("shape.angle",
                       "is the slope of a wedge's flanks; a shape is inclined by tilt");
  }
  const bool has_direction =
      kind == ShapeKind::kCylinder || kind == ShapeKind::kWedge || kind == ShapeKind::kEdge;
  if (raw.direction_rad != 0.0 && !has_direction) {
    throw SceneMistake("shape.direction", "belongs to a cylinder, a wedge or an edge");
  }
  if (!raw.file.empty() && kind != ShapeKind::kTable) {
    throw SceneMistake("shape.file", "belongs to kind = \"table\"");
  }
}

void fill_kind(const RawShape& raw, const std::filesystem::path& folder, RigidShape& shape) {
  refuse_strangers(raw, shape.kind);
  if (is_round(shape.kind) && !(raw.radius_m > 0.0)) {
    throw SceneMistake("shape", "needs a radius, such as radius = \"100 mm\"");
  }
  shape.radius_m = raw.radius_m;
  if (shape.kind == ShapeKind::kWedge) {
    if (raw.angle_rad == 0.0) {
      throw SceneMistake("shape", "needs the angle of its flanks, such as angle = \"5 degree\"");
    }
    if (!(raw.angle_rad < 0.25 * std::numbers::pi)) {
      throw SceneMistake("shape.angle", "is 45 degrees or more; tops are taken to be nearly level");
    }
    shape.slope = std::tan(raw.angle_rad);
  }
  if (shape.kind != ShapeKind::kTable) return;
  if (raw.file.empty()) {
    throw SceneMistake("shape", "needs file = \"heights.csv\" with columns x, y and z");
  }
  shape.table = read_heights(folder / raw.file);
}

}  // namespace

void show_shape(FieldVisitor& v, RawShape& s) {
  v.text({"kind", "sphere"}, s.kind);
  v.quantity({.key = "radius", .unit = "m", .range = Range::kPositive}, s.radius_m);
  v.quantity({.key = "depth", .unit = "m", .range = Range::kPositive}, s.depth_m);
  v.quantity({.key = "force", .unit = "N", .range = Range::kPositive}, s.force_N);
  v.text({"friction", "none"}, s.friction);
  v.quantities({.key = "at", .unit = "m"}, s.at_m);
  v.quantities({.key = "tilt", .unit = "rad"}, s.tilt_rad);
  v.quantity({.key = "direction", .unit = "rad"}, s.direction_rad);
  v.quantity({.key = "angle", .unit = "rad", .range = Range::kPositive}, s.angle_rad);
  v.text({"file", "heights.csv"}, s.file);
}

std::optional<ShapePress> press_from(const RawShape& raw, const std::filesystem::path& folder) {
  const bool is_empty = raw.depth_m == 0.0 && raw.force_N == 0.0 && raw.radius_m == 0.0;
  if (raw.kind.empty() && is_empty) return {};
  ShapePress press;
  RigidShape& shape = press.shape;
  shape.kind = choice<ShapeKind>("shape.kind", raw.kind,
                                 {{"plane", ShapeKind::kPlane},
                                  {"cylinder", ShapeKind::kCylinder},
                                  {"sphere", ShapeKind::kSphere},
                                  {"paraboloid", ShapeKind::kParaboloid},
                                  {"wedge", ShapeKind::kWedge},
                                  {"edge", ShapeKind::kEdge},
                                  {"table", ShapeKind::kTable}});
  choice<bool>("shape.friction", raw.friction, {{"none", false}});
  fill_kind(raw, folder, shape);
  std::tie(shape.x_m, shape.y_m) = pair_of("at", raw.at_m);
  const auto [tilt_x, tilt_y] = pair_of("tilt", raw.tilt_rad);
  constexpr double kSteepest = 0.25 * std::numbers::pi;
  if (std::abs(tilt_x) > kSteepest || std::abs(tilt_y) > kSteepest) {
    throw SceneMistake("shape.tilt", "is more than 45 degrees; tops are taken to be nearly level");
  }
  shape.tilt_x = std::tan(tilt_x);
  shape.tilt_y = std::tan(tilt_y);
  shape.direction_rad = raw.direction_rad;
  press.depth_m = raw.depth_m;
  press.force_N = raw.force_N;
  return press;
}

}  // namespace viscard
