#include "models/array/contact/shape_press.h"

#include "models/answer/scene_mistake.h"

#include <cmath>

namespace viscard {

void check_adhesion(const ShapePress& press) {
  const double work_J_m2 = press.work_of_adhesion_J_m2;
  if (!(work_J_m2 >= 0.0) || !std::isfinite(work_J_m2)) {
    throw SceneMistake("shape.work_of_adhesion", "must not be negative");
  }
  if (work_J_m2 == 0.0) {
    if (press.before_m.empty()) return;
    throw SceneMistake("shape.before",
                       "matters only where tops are held; give a work_of_adhesion, such as \"40 "
                       "mJ/m2\"");
  }
  for (const double depth_m : path_of(press)) {
    if (std::isfinite(depth_m)) continue;
    throw SceneMistake("shape.before", "has a depth that is not a number");
  }
  if (press.force_N > 0.0) {
    throw SceneMistake(
        "shape.force",
        "cannot stand beside a work of adhesion: at one force a shape may be held or "
        "free; give a depth, and in shape.before those that it went through");
  }
}

}  // namespace viscard
