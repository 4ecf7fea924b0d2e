#pragma once

#include "io/config/config_fields.h"
#include "models/array/contact/rough_surface.h"
#include "models/array/contact/shape_press.h"

#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace viscard {

// An entry of shape.path. NaN: not given.
struct RawStop {
  double time_s = 0.0, x_m = 0.0, y_m = 0.0;
  double depth_m = std::numeric_limits<double>::quiet_NaN();
  double force_N = std::numeric_limits<double>::quiet_NaN();
};

// The section [shape] of a scene before it is checked.
struct RawShape {
  std::string kind, friction = "none", file;
  double radius_m = 0.0, depth_m = 0.0, force_N = 0.0;
  double angle_rad = 0.0, direction_rad = 0.0;
  double rms_m = 0.0, correlation_length_m = 0.0;  // of a rough surface
  std::int64_t seed = 0;
  std::vector<double> at_m, tilt_rad;
  double work_of_adhesion_J_m2 = 0.0;
  std::vector<double> before_m;
  std::vector<RawStop> path;  // of arrays
};

// `may_move`: with a path.
void show_shape(FieldVisitor& visitor, RawShape& shape, bool may_move = false);

// Nothing without a kind. Throws SceneMistake naming what is wrong, std::runtime_error for a file.
// A rough surface, without end, is drawn over what it may touch.
std::optional<ShapePress> press_from(const RawShape& raw, const std::filesystem::path& folder,
                                     const RoughExtent& touchable);

}  // namespace viscard
