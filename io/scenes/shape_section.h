#pragma once

#include "io/config/config_fields.h"
#include "models/array/contact/rough_surface.h"
#include "models/array/contact/shape_press.h"

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace viscard {

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
};

void show_shape(FieldVisitor& visitor, RawShape& shape);

// Nothing without a kind. Throws SceneMistake naming what is wrong, std::runtime_error for a file.
// A rough surface, without end, is drawn over what it may touch.
std::optional<ShapePress> press_from(const RawShape& raw, const std::filesystem::path& folder,
                                     const RoughExtent& touchable);

}  // namespace viscard
