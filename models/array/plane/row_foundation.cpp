// The row under its shape as independent columns, before anything is solved.
#include "models/answer/scene_mistake.h"
#include "models/array/contact/pull_off.h"
#include "models/array/plane/row_contact.h"
#include "models/maths/text_of_number.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace viscard {
namespace {

FoundationColumn column_under(const ArrayScene& scene, int pillar, double limit_Pa) {
  constexpr int kPoints = 40;  // intervals of Simpson's rule
  const double width_m = scene.geometry.diameter_m, length_m = scene.geometry.length_m;
  const double left_m = place_m(scene.geometry, pillar) - 0.5 * width_m;
  const auto surface_m = [&](int i) {
    return height_m(scene.press->shape, left_m + width_m * i / kPoints, 0.0);
  };
  FoundationColumn column{.lowest_m = HUGE_VAL,
                          .highest_m = -HUGE_VAL,
                          .area_m2 = width_m,
                          .length_m = length_m,
                          .radius_m = 0.5 * width_m,
                          .stiffness_Pa_m = scene.pillar.E0_Pa / length_m,
                          .limit_Pa = limit_Pa};
  for (int i = 0; i <= kPoints; ++i) {
    const double at_m = surface_m(i);
    column.lowest_m = std::min(column.lowest_m, at_m);
    column.highest_m = std::max(column.highest_m, at_m);
    const bool is_end = i == 0 || i == kPoints;
    column.mean_m += (is_end ? 1.0 : i % 2 == 1 ? 4.0 : 2.0) * at_m / (3.0 * kPoints);
  }
  // Where the surface ends above a top, its covered part counts.
  if (!std::isfinite(column.mean_m)) {
    column.mean_m = column.lowest_m;
    return column;
  }
  for (int i = 0; i < kPoints / 2; ++i) {
    const double middle_m = 0.5 * (surface_m(i) + surface_m(kPoints - i));
    column.bent_m = std::max(column.bent_m, std::abs(middle_m - surface_m(kPoints / 2)));
  }
  return column;
}

}  // namespace

double row_pull_off_N_m(const ArrayScene& scene, double work_J_m2) {
  const double nu = scene.pillar.nu;
  const double plane_Pa =
      scene.pillar.E0_Pa / (scene.plane == PlaneState::kStress ? 1.0 : 1.0 - nu * nu);
  return strip_pull_off_N_m(scene.geometry.diameter_m, plane_Pa, work_J_m2);
}

FoundationPress row_foundation(const ArrayScene& scene) {
  const ShapePress& press = *scene.press;
  const double limit_Pa =
      row_pull_off_N_m(scene, press.work_of_adhesion_J_m2) / scene.geometry.diameter_m;
  std::vector<FoundationColumn> columns;
  for (int i = 0; i < scene.geometry.count; ++i) {
    columns.push_back(column_under(scene, i, limit_Pa));
  }
  const bool wants_release =
      scene.wanted.empty() ||
      std::any_of(scene.wanted.begin(), scene.wanted.end(),
                  [](const std::string& name) { return name.starts_with("release_depth"); });
  return foundation_press(columns, press, wants_release);
}

void refuse_missed_row_tips(const ArrayScene& scene, double depth_m) {
  constexpr int kNodes = 320;  // of the finest grid (row_contact.cpp)
  const ArrayGeometry& g = scene.geometry;
  const RigidShape& shape = scene.press->shape;
  const double half_m = 0.5 * g.diameter_m, step_m = g.diameter_m / kNodes;
  if (shape.kind != ShapeKind::kTable || finest_step_m(shape) > 2.0 * step_m) return;
  for (int pillar = 0; pillar < g.count; ++pillar) {
    const double at_m = place_m(g, pillar);
    const auto reach_m = [&](double x_m) { return depth_m - height_m(shape, at_m + x_m, 0.0); };
    double deepest_m = -HUGE_VAL, seen_m = -HUGE_VAL;
    for (const double node_m : shape.table.x_m) {
      const double x_m = node_m + shape.x_m - at_m;
      if (std::abs(x_m) <= half_m) deepest_m = std::max(deepest_m, reach_m(x_m));
    }
    if (!(deepest_m > 0.0)) continue;
    for (int i = 0; i <= kNodes; ++i) seen_m = std::max(seen_m, reach_m(i * step_m - half_m));
    if (seen_m >= 0.5 * deepest_m) continue;
    throw SceneMistake("shape.file", "has a tip over pillar " + std::to_string(pillar + 1) +
                                         " that is narrower than the finest grid of its top, " +
                                         micrometres(step_m, 2) +
                                         "; give heights that are smooth over that length");
  }
}

}  // namespace viscard
