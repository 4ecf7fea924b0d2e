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

// The surface above one top.
struct SurfaceAbove {
  double lowest_m = HUGE_VAL, highest_m = -HUGE_VAL, mean_m = 0.0;
  double bent_m = 0.0;  // in the middle, between points on both sides
};

SurfaceAbove surface_above(const ArrayScene& scene, int pillar) {
  constexpr int kPoints = 40;  // intervals of Simpson's rule
  const double width_m = scene.geometry.diameter_m;
  const double left_m = place_m(scene.geometry, pillar) - 0.5 * width_m;
  const auto surface_m = [&](int i) {
    return height_m(scene.press->shape, left_m + width_m * i / kPoints, 0.0);
  };
  SurfaceAbove above;
  for (int i = 0; i <= kPoints; ++i) {
    const double at_m = surface_m(i);
    above.lowest_m = std::min(above.lowest_m, at_m);
    above.highest_m = std::max(above.highest_m, at_m);
    const bool is_end = i == 0 || i == kPoints;
    above.mean_m += (is_end ? 1.0 : i % 2 == 1 ? 4.0 : 2.0) * at_m / (3.0 * kPoints);
  }
  // Where the surface ends above a top, its covered part counts.
  if (!std::isfinite(above.mean_m)) {
    above.mean_m = above.lowest_m;
    return above;
  }
  for (int i = 0; i < kPoints / 2; ++i) {
    const double middle_m = 0.5 * (surface_m(i) + surface_m(kPoints - i));
    above.bent_m = std::max(above.bent_m, std::abs(middle_m - surface_m(kPoints / 2)));
  }
  return above;
}

// By bisection; infinite if no column lies under the shape.
double foundation_depth_m(const std::vector<SurfaceAbove>& columns, double stiffness_Pa,
                          double force_N_m) {
  double low_m = HUGE_VAL;
  for (const SurfaceAbove& one : columns) low_m = std::min(low_m, one.mean_m);
  if (!std::isfinite(low_m)) return low_m;
  double high_m = low_m + force_N_m / stiffness_Pa;  // one column alone bears it
  for (int i = 0; i < 60; ++i) {
    const double middle_m = 0.5 * (low_m + high_m);
    double sum = 0.0;
    for (const SurfaceAbove& one : columns) {
      sum += stiffness_Pa * std::max(middle_m - one.mean_m, 0.0);
    }
    (sum < force_N_m ? low_m : high_m) = middle_m;
  }
  return high_m;
}

}  // namespace

double row_pull_off_N_m(const ArrayScene& scene, double work_J_m2) {
  const double nu = scene.pillar.nu;
  const double plane_Pa =
      scene.pillar.E0_Pa / (scene.plane == PlaneState::kStress ? 1.0 : 1.0 - nu * nu);
  return strip_pull_off_N_m(scene.geometry.diameter_m, plane_Pa, work_J_m2);
}

namespace {

double row_pull_Pa(const ArrayScene& scene, const std::vector<SurfaceAbove>& columns) {
  const ShapePress& press = *scene.press;
  if (!(press.work_of_adhesion_J_m2 > 0.0)) return 0.0;
  const ArrayGeometry& g = scene.geometry;
  const double limit_Pa = row_pull_off_N_m(scene, press.work_of_adhesion_J_m2) / g.diameter_m;
  const bool wants_release =
      scene.wanted.empty() ||
      std::any_of(scene.wanted.begin(), scene.wanted.end(),
                  [](const std::string& name) { return name.starts_with("release_depth"); });
  double pull_Pa = 0.0;
  for (const SurfaceAbove& one : columns) {
    const PulledColumn column{.lowest_m = one.lowest_m,
                              .mean_m = one.mean_m,
                              .highest_m = one.highest_m,
                              .stiffness_Pa_m = scene.pillar.E0_Pa / g.length_m,
                              .limit_Pa = limit_Pa};
    pull_Pa = std::max(pull_Pa, largest_pull_Pa(column, path_of(press), wants_release));
  }
  return pull_Pa;
}

}  // namespace

RowFoundation row_foundation(const ArrayScene& scene) {
  const ArrayGeometry& g = scene.geometry;
  const ShapePress& press = *scene.press;
  std::vector<SurfaceAbove> columns;
  for (int i = 0; i < g.count; ++i) columns.push_back(surface_above(scene, i));
  const double stiffness_Pa = scene.pillar.E0_Pa * g.diameter_m / g.length_m;
  RowFoundation row;
  row.depth_m = press.force_N > 0.0 ? foundation_depth_m(columns, stiffness_Pa, press.force_N)
                                    : press.depth_m;
  double overlap_m = 0.0, lifted_m = 0.0;
  for (const SurfaceAbove& one : columns) {
    row.touches = row.touches || std::isfinite(one.lowest_m);
    row.covers_all = row.covers_all && std::isfinite(one.highest_m);
    const double mean_m = row.depth_m - one.mean_m;
    row.shortening = std::max(row.shortening, mean_m / g.length_m);
    overlap_m = std::max(overlap_m, row.depth_m - one.lowest_m);
    const double pulled_m = kPullOfBend * one.bent_m * 2.0 * g.length_m / g.diameter_m + one.mean_m;
    lifted_m = std::max(lifted_m, std::max(one.highest_m, pulled_m) - row.depth_m);
  }
  row.largest_Pa = scene.pillar.E0_Pa * row.shortening;
  row.pull_Pa = row_pull_Pa(scene, columns);
  if (overlap_m > 0.0) row.lift = std::min(lifted_m / overlap_m, 1.0);
  return row;
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
