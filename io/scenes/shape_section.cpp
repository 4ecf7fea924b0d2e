#include "io/config/quantity_text.h"
#include "io/scenes/pillar_positions.h"
#include "io/scenes/scene_fields.h"
#include "models/maths/text_of_number.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <numbers>
#include <tuple>

namespace viscard {
namespace {

// A rough surface is a table that is drawn.
struct KindOfShape {
  ShapeKind kind = ShapeKind::kPlane;
  bool is_rough = false;
  bool operator==(const KindOfShape&) const = default;  // the same word
};

const WordTable<KindOfShape>& kinds_of_shape() {
  static const WordTable<KindOfShape> kWords = {
      {"plane", {ShapeKind::kPlane}},   {"cylinder", {ShapeKind::kCylinder}},
      {"sphere", {ShapeKind::kSphere}}, {"paraboloid", {ShapeKind::kParaboloid}},
      {"wedge", {ShapeKind::kWedge}},   {"edge", {ShapeKind::kEdge}},
      {"table", {ShapeKind::kTable}},   {"rough", {ShapeKind::kTable, true}}};
  return kWords;
}

// What stands in [shape]. press holds the keys that it has as they stand; its point, tilt and slope follow from the others.
struct ShapeKeys {
  std::optional<KindOfShape> kind;
  ShapePress press;
  std::string friction = "none";
  double angle_rad = 0.0;
  std::vector<double> at_m, tilt_rad;
};

ShapeKeys keys_of(const ShapePress& press) {
  const RigidShape& shape = press.shape;
  ShapeKeys keys{.kind = KindOfShape{shape.kind, shape.table.is_random}, .press = press};
  if (shape.kind == ShapeKind::kWedge) keys.angle_rad = std::atan(shape.slope);
  const double share = press.friction_coefficient;
  keys.friction = press.friction == Friction::kNone ? "none"
                  : press.friction == Friction::kStick || !std::isfinite(share)
                      ? "stick"
                      : text_of(share, 17);
  keys.at_m = {shape.x_m, shape.y_m};
  keys.tilt_rad = {std::atan(shape.tilt_x), std::atan(shape.tilt_y)};
  return keys;
}

std::pair<double, double> pair_of(const char* key, const std::vector<double>& values) {
  if (values.empty()) return {0.0, 0.0};
  if (values.size() != 2) {
    throw SceneMistake(std::string("shape.") + key, "needs two values, along x and along y");
  }
  return {values[0], values[1]};
}

// Keys that another kind of shape has.
void refuse_strangers(const ShapeKeys& keys, const SceneSources& sources) {
  const ShapeKind kind = keys.kind->kind;
  if (keys.press.shape.radius_m > 0.0 && !is_round(kind)) {
    throw SceneMistake("shape.radius", "belongs to a cylinder, a sphere or a paraboloid");
  }
  if (keys.angle_rad != 0.0 && kind != ShapeKind::kWedge) {
    throw SceneMistake("shape.angle",
                       "is the slope of a wedge's flanks; a shape is inclined by tilt");
  }
  const bool has_direction =
      kind == ShapeKind::kCylinder || kind == ShapeKind::kWedge || kind == ShapeKind::kEdge;
  if (keys.press.shape.direction_rad != 0.0 && !has_direction) {
    throw SceneMistake("shape.direction", "belongs to a cylinder, a wedge or an edge");
  }
  const RoughSurface& rough = sources.rough;
  const bool has_roughness =
      rough.rms_m > 0.0 || rough.correlation_length_m > 0.0 || rough.seed != 0;
  if (has_roughness && !keys.kind->is_rough) {
    throw SceneMistake(rough.rms_m > 0.0                  ? "shape.rms"
                       : rough.correlation_length_m > 0.0 ? "shape.correlation_length"
                                                          : "shape.seed",
                       "belongs to kind = \"rough\"");
  }
  if (!sources.heights.empty() && (keys.kind->is_rough || kind != ShapeKind::kTable)) {
    throw SceneMistake("shape.file", "belongs to kind = \"table\"");
  }
}

// A word, or a number for a shape that moves.
void fill_friction(const std::string& friction, ShapePress& press) {
  press.friction = Friction::kNone;
  if (friction.empty() || friction == "none") return;
  if (friction == "stick") {
    press.friction = Friction::kStick;
    return;
  }
  constexpr const char* kRight =
      "must be \"none\", \"stick\" or a number that is not negative, such as 0.3";
  try {
    press.friction_coefficient = quantity_from_text(friction, "1");
  } catch (const std::exception&) {
    throw SceneMistake("shape.friction", "is '" + friction + "'; it " + kRight);
  }
  if (!(press.friction_coefficient >= 0.0) || !std::isfinite(press.friction_coefficient)) {
    throw SceneMistake("shape.friction", kRight);
  }
  if (press.friction_coefficient > 0.0) press.friction = Friction::kCoulomb;
}

// What the shape may touch as seen from its point `at`, all along a path.
RoughExtent touchable_along(const ShapePath* path, const RoughExtent& touchable) {
  RoughExtent all = touchable;
  for (std::size_t i = 0; path != nullptr && i < path->size(); ++i) {
    const PathStop& stop = (*path)[i];
    const RoughExtent here{touchable.low_x_m - stop.x_m, touchable.high_x_m - stop.x_m,
                           touchable.low_y_m - stop.y_m, touchable.high_y_m - stop.y_m};
    if (i == 0) all = here;
    all = {std::min(all.low_x_m, here.low_x_m), std::max(all.high_x_m, here.high_x_m),
           std::min(all.low_y_m, here.low_y_m), std::max(all.high_y_m, here.high_y_m)};
  }
  return all;
}

// Random heights stand in for a table, around the point `at`.
void fill_rough(const RoughSurface& surface, const RoughExtent& touchable, RigidShape& shape) {
  if (!(surface.rms_m > 0.0) || !(surface.correlation_length_m > 0.0)) {
    throw SceneMistake("shape",
                       "is rough, which needs rms and correlation_length, such as rms = "
                       "\"0.25 um\", correlation_length = \"75 um\"");
  }
  const RoughExtent around{touchable.low_x_m - shape.x_m, touchable.high_x_m - shape.x_m,
                           touchable.low_y_m - shape.y_m, touchable.high_y_m - shape.y_m};
  if (rough_places(surface, around) > kMostRoughPlaces) {
    throw SceneMistake("shape.correlation_length",
                       "is too small: the surface over all that it may touch would need more than "
                       "four million heights, a sixteenth of this length apart");
  }
  shape.table = rough_heights(surface, around);
}

void fill_kind(const ShapeKeys& keys, const SceneFile& file,
               const std::function<RoughExtent()>& touchable, RigidShape& shape) {
  shape.kind = keys.kind->kind;
  refuse_strangers(keys, file.sources);
  if (is_round(shape.kind) && !(shape.radius_m > 0.0)) {
    throw SceneMistake("shape", "needs a radius, such as radius = \"100 mm\"");
  }
  if (shape.kind == ShapeKind::kWedge) {
    if (keys.angle_rad == 0.0) {
      throw SceneMistake("shape", "needs the angle of its flanks, such as angle = \"5 degree\"");
    }
    if (!(keys.angle_rad < 0.25 * std::numbers::pi)) {
      throw SceneMistake("shape.angle", "is 45 degrees or more; tops are taken to be nearly level");
    }
    shape.slope = std::tan(keys.angle_rad);
  }
  if (keys.kind->is_rough) return fill_rough(file.sources.rough, touchable(), shape);
  if (shape.kind != ShapeKind::kTable) return;
  const std::string& heights = file.sources.heights;
  if (heights.empty()) {
    throw SceneMistake("shape", "needs file = \"heights.csv\" with columns x, y and z");
  }
  shape.table = read_heights(named_file("shape.file", file, heights, FileKind::kTable));
}

ShapePress press_from(const ShapeKeys& keys, const SceneFile& file,
                      const std::function<RoughExtent()>& touchable) {
  if (!keys.kind) {
    throw SceneMistake("shape", "needs its kind, such as kind = \"sphere\"");
  }
  ShapePress press = keys.press;
  RigidShape& shape = press.shape;
  fill_friction(keys.friction, press);
  std::tie(shape.x_m, shape.y_m) = pair_of("at", keys.at_m);
  fill_kind(keys, file, touchable, shape);
  const auto [tilt_x, tilt_y] = pair_of("tilt", keys.tilt_rad);
  constexpr double kSteepest = 0.25 * std::numbers::pi;
  if (std::abs(tilt_x) > kSteepest || std::abs(tilt_y) > kSteepest) {
    throw SceneMistake("shape.tilt", "is more than 45 degrees; tops are taken to be nearly level");
  }
  shape.tilt_x = std::tan(tilt_x);
  shape.tilt_y = std::tan(tilt_y);
  if (press.depth_m < 0.0 && press.before_m.empty()) {
    throw SceneMistake("shape.depth",
                       "must be positive: above the tops a shape touches nothing, unless it was "
                       "deeper before and adhesion holds it (shape.before, work_of_adhesion)");
  }
  return press;
}

}  // namespace

void show_shape(FieldVisitor& v, SceneFile& file, const ShapePress* now,
                const std::function<RoughExtent()>& touchable,
                const std::function<void(const ShapePress&)>& place,
                const std::shared_ptr<ShapePath>& path) {
  const auto keys = std::make_shared<ShapeKeys>(now == nullptr ? ShapeKeys{} : keys_of(*now));
  ShapePress& press = keys->press;
  RoughSurface& rough = file.sources.rough;
  v.section("shape", [&](FieldVisitor& s) {
    s.choice({"kind", "sphere"}, kinds_of_shape(), keys->kind);
    s.quantity({.key = "radius", .unit = quantities::kShapeRadius, .range = Range::kPositive},
               press.shape.radius_m);
    s.quantity({.key = "depth", .unit = "m"}, press.depth_m);
    s.quantity({.key = "force", .unit = "N", .range = Range::kPositive}, press.force_N);
    s.text({.key = "friction", .example = "none", .may_be_number = true}, keys->friction);
    s.quantities({.key = "at", .unit = "m"}, keys->at_m);
    s.quantities({.key = "tilt", .unit = "rad"}, keys->tilt_rad);
    s.quantity({.key = "direction", .unit = "rad"}, press.shape.direction_rad);
    s.quantity({.key = "angle", .unit = "rad", .range = Range::kPositive}, keys->angle_rad);
    s.text({"file", "heights.csv"}, file.sources.heights);
    s.quantity({.key = "rms", .unit = "m", .range = Range::kPositive}, rough.rms_m);
    s.quantity({.key = "correlation_length", .unit = "m", .range = Range::kPositive},
               rough.correlation_length_m);
    s.integer("seed", 0, 1'000'000'000, rough.seed);
    s.quantity({.key = "work_of_adhesion", .unit = "J/m2", .range = Range::kPositive},
               press.work_of_adhesion_J_m2);
    s.quantities({.key = "before", .unit = "m"}, press.before_m);
    if (!path) return;
    s.list(
        "path", path->size(), [&](std::size_t n) { path->resize(n); },
        [&](FieldVisitor& p, std::size_t i) {
          PathStop& stop = (*path)[i];
          p.quantity(
              {.key = "time", .unit = "s", .range = Range::kNotNegative, .is_required = true},
              stop.time_s);
          p.quantity({.key = "x", .unit = "m"}, stop.x_m);
          p.quantity({.key = "y", .unit = "m"}, stop.y_m);
          p.quantity({.key = "depth", .unit = "m"}, stop.depth_m);
          p.quantity({.key = "force", .unit = "N"}, stop.force_N);
        });
  });
  v.after_all_keys(
      [&file, keys,
       touchable = [touchable, path] { return touchable_along(path.get(), touchable()); }, place] {
        const ShapePress& given = keys->press;
        const bool is_empty =
            given.depth_m == 0.0 && given.force_N == 0.0 && given.shape.radius_m == 0.0;
        if (keys->kind || !is_empty) place(press_from(*keys, file, touchable));
      });
}

}  // namespace viscard
