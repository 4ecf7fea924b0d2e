#include "io/scenes/shape_section.h"

#include "io/config/quantity_text.h"
#include "io/scenes/pillar_positions.h"
#include "io/scenes/scene_words.h"
#include "models/pillar/mesh/scene_mistake.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numbers>
#include <tuple>

namespace viscard {
namespace {

constexpr const char* kRough = "rough";

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
  const bool has_roughness = raw.rms_m > 0.0 || raw.correlation_length_m > 0.0 || raw.seed != 0;
  if (has_roughness && raw.kind != kRough) {
    throw SceneMistake(raw.rms_m > 0.0                  ? "shape.rms"
                       : raw.correlation_length_m > 0.0 ? "shape.correlation_length"
                                                        : "shape.seed",
                       "belongs to kind = \"rough\"");
  }
  if (!raw.file.empty() && raw.kind == kRough) {
    throw SceneMistake("shape.file", "belongs to kind = \"table\"");
  }
  if (!raw.file.empty() && kind != ShapeKind::kTable) {
    throw SceneMistake("shape.file", "belongs to kind = \"table\"");
  }
}

// A word, or a number for a shape that moves.
void fill_friction(const RawShape& raw, ShapePress& press) {
  const bool is_word =
      raw.friction.empty() || std::isalpha(static_cast<unsigned char>(raw.friction.front())) != 0;
  if (is_word) {
    press.friction = choice<Friction>("shape.friction", raw.friction,
                                      {{"none", Friction::kNone}, {"stick", Friction::kStick}});
    return;
  }
  at_key("shape.friction",
         [&] { press.friction_coefficient = quantity_from_text(raw.friction, "1"); });
  if (!(press.friction_coefficient >= 0.0) || !std::isfinite(press.friction_coefficient)) {
    throw SceneMistake("shape.friction",
                       "must be \"none\", \"stick\" or a number that is not "
                       "negative, such as 0.3");
  }
  if (press.friction_coefficient > 0.0) press.friction = Friction::kCoulomb;
}

// What the shape may touch as seen from its point `at`, all along a path.
RoughExtent touchable_along(const std::vector<RawStop>& path, const RoughExtent& touchable) {
  RoughExtent all = touchable;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const RawStop& stop = path[i];
    const RoughExtent here{touchable.low_x_m - stop.x_m, touchable.high_x_m - stop.x_m,
                           touchable.low_y_m - stop.y_m, touchable.high_y_m - stop.y_m};
    if (i == 0) all = here;
    all = {std::min(all.low_x_m, here.low_x_m), std::max(all.high_x_m, here.high_x_m),
           std::min(all.low_y_m, here.low_y_m), std::max(all.high_y_m, here.high_y_m)};
  }
  return all;
}

// Random heights stand in for a table, around the point `at`.
void fill_rough(const RawShape& raw, const RoughExtent& touchable, RigidShape& shape) {
  if (!(raw.rms_m > 0.0) || !(raw.correlation_length_m > 0.0)) {
    throw SceneMistake("shape",
                       "is rough, which needs rms and correlation_length, such as rms = "
                       "\"0.25 um\", correlation_length = \"75 um\"");
  }
  const RoughSurface surface{raw.rms_m, raw.correlation_length_m,
                             static_cast<std::uint64_t>(raw.seed)};
  const RoughExtent around{touchable.low_x_m - shape.x_m, touchable.high_x_m - shape.x_m,
                           touchable.low_y_m - shape.y_m, touchable.high_y_m - shape.y_m};
  if (rough_places(surface, around) > kMostRoughPlaces) {
    throw SceneMistake("shape.correlation_length",
                       "is too small: the surface over all that it may touch would need more than "
                       "four million heights, a sixteenth of this length apart");
  }
  shape.table = rough_heights(surface, around);
}

void fill_kind(const RawShape& raw, const std::filesystem::path& folder,
               const RoughExtent& touchable, RigidShape& shape) {
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
  if (raw.kind == kRough) return fill_rough(raw, touchable, shape);
  if (shape.kind != ShapeKind::kTable) return;
  if (raw.file.empty()) {
    throw SceneMistake("shape", "needs file = \"heights.csv\" with columns x, y and z");
  }
  shape.table = read_heights(named_file("shape.file", folder, raw.file, FileKind::kTable));
}

}  // namespace

void show_shape(FieldVisitor& v, RawShape& s, bool may_move) {
  v.text({"kind", "sphere"}, s.kind);
  v.quantity({.key = "radius", .unit = quantities::kShapeRadius, .range = Range::kPositive},
             s.radius_m);
  v.quantity({.key = "depth", .unit = "m"}, s.depth_m);
  v.quantity({.key = "force", .unit = "N", .range = Range::kPositive}, s.force_N);
  v.text({.key = "friction", .example = "none", .may_be_number = true}, s.friction);
  v.quantities({.key = "at", .unit = "m"}, s.at_m);
  v.quantities({.key = "tilt", .unit = "rad"}, s.tilt_rad);
  v.quantity({.key = "direction", .unit = "rad"}, s.direction_rad);
  v.quantity({.key = "angle", .unit = "rad", .range = Range::kPositive}, s.angle_rad);
  v.text({"file", "heights.csv"}, s.file);
  v.quantity({.key = "rms", .unit = "m", .range = Range::kPositive}, s.rms_m);
  v.quantity({.key = "correlation_length", .unit = "m", .range = Range::kPositive},
             s.correlation_length_m);
  v.integer("seed", 0, 1'000'000'000, s.seed);
  v.quantity({.key = "work_of_adhesion", .unit = "J/m2", .range = Range::kPositive},
             s.work_of_adhesion_J_m2);
  v.quantities({.key = "before", .unit = "m"}, s.before_m);
  if (!may_move) return;
  v.list(
      "path", s.path.size(), [&](std::size_t n) { s.path.resize(n); },
      [&](FieldVisitor& p, std::size_t i) {
        RawStop& stop = s.path[i];
        p.quantity({.key = "time", .unit = "s", .range = Range::kNotNegative, .is_required = true},
                   stop.time_s);
        p.quantity({.key = "x", .unit = "m"}, stop.x_m);
        p.quantity({.key = "y", .unit = "m"}, stop.y_m);
        p.quantity({.key = "depth", .unit = "m"}, stop.depth_m);
        p.quantity({.key = "force", .unit = "N"}, stop.force_N);
      });
}

std::optional<ShapePress> press_from(const RawShape& raw, const std::filesystem::path& folder,
                                     const RoughExtent& touchable) {
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
                                  {"table", ShapeKind::kTable},
                                  {kRough, ShapeKind::kTable}});
  fill_friction(raw, press);
  std::tie(shape.x_m, shape.y_m) = pair_of("at", raw.at_m);
  fill_kind(raw, folder, touchable_along(raw.path, touchable), shape);
  const auto [tilt_x, tilt_y] = pair_of("tilt", raw.tilt_rad);
  constexpr double kSteepest = 0.25 * std::numbers::pi;
  if (std::abs(tilt_x) > kSteepest || std::abs(tilt_y) > kSteepest) {
    throw SceneMistake("shape.tilt", "is more than 45 degrees; tops are taken to be nearly level");
  }
  shape.tilt_x = std::tan(tilt_x);
  shape.tilt_y = std::tan(tilt_y);
  shape.direction_rad = raw.direction_rad;
  if (raw.depth_m < 0.0 && raw.before_m.empty()) {
    throw SceneMistake("shape.depth",
                       "must be positive: above the tops a shape touches nothing, unless it was "
                       "deeper before and adhesion holds it (shape.before, work_of_adhesion)");
  }
  press.depth_m = raw.depth_m;
  press.work_of_adhesion_J_m2 = raw.work_of_adhesion_J_m2;
  press.before_m = raw.before_m;
  press.force_N = raw.force_N;
  return press;
}

}  // namespace viscard
