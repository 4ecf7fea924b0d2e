// The array under its shape as independent columns, an estimate before anything is solved; and forces on tops as loads.
#include "models/answer/scene_mistake.h"
#include "models/array/contact/round_tip.h"
#include "models/array/space/space_contact.h"
#include "models/array/space/space_maps.h"
#include "models/maths/text_of_number.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace viscard {
namespace {

FoundationColumn column_under(const RigidShape& shape, const SpacePillar& one,
                              const SpaceClass& kind, double above_m) {
  constexpr int kAngles = 8;
  const double R_m = 0.5 * kind.diameter_m;
  const double centre_m = height_m(shape, one.x_m, one.y_m) - above_m;
  FoundationColumn column{.lowest_m = centre_m,
                          .mean_m = 0.5 * centre_m,
                          .highest_m = centre_m,
                          .area_m2 = std::numbers::pi * R_m * R_m,
                          .length_m = kind.length_m,
                          .radius_m = R_m,
                          .stiffness_Pa_m = kind.material.E0_Pa / kind.length_m};
  std::array<double, kAngles> rims_m{};
  for (int a = 0; a < kAngles; ++a) {
    const double angle = 2.0 * std::numbers::pi * a / kAngles;
    const double rim_m =
        height_m(shape, one.x_m + R_m * std::cos(angle), one.y_m + R_m * std::sin(angle)) - above_m;
    column.lowest_m = std::min(column.lowest_m, rim_m);
    column.highest_m = std::max(column.highest_m, rim_m);
    column.mean_m += 0.5 * rim_m / kAngles;  // exact for a paraboloid
    rims_m[static_cast<std::size_t>(a)] = rim_m;
  }
  if (const auto tip = round_tip(shape, one.x_m, one.y_m, R_m, HUGE_VAL)) {
    column.lowest_m = std::min(column.lowest_m,
                               height_m(shape, one.x_m + tip->x_m, one.y_m + tip->y_m) - above_m);
  }
  for (std::size_t a = 0; 2 * a < rims_m.size() && std::isfinite(column.highest_m); ++a) {
    const double middle_m = 0.5 * (rims_m[a] + rims_m[a + kAngles / 2]);
    column.bent_m = std::max(column.bent_m, std::abs(middle_m - centre_m));
  }
  // If the surface ends above a top, only the covered part of the top counts.
  if (!std::isfinite(column.mean_m)) column.mean_m = column.lowest_m;
  return column;
}

std::vector<FoundationColumn> columns_under(const SpaceScene& scene) {
  const std::vector<SpaceClass> classes = classes_of(scene);
  std::vector<FoundationColumn> columns;
  columns.reserve(scene.pillars.size());
  for (const SpacePillar& one : scene.pillars) {
    const SpaceClass& kind = classes[static_cast<std::size_t>(one.of_class)];
    FoundationColumn column =
        column_under(scene.press->shape, one, kind, kind.length_m - scene.length_m);
    const double work_J_m2 = scene.press->work_of_adhesion_J_m2;
    if (work_J_m2 > 0.0) column.limit_Pa = class_pull_off_N(kind, work_J_m2) / column.area_m2;
    columns.push_back(column);
  }
  return columns;
}

}  // namespace

void refuse_missed_tips(const SpaceScene& scene, double depth_m) {
  constexpr int kRings = 48, kAngles = 128;  // of the finest grid (space_contact.cpp)
  const RigidShape& shape = scene.press->shape;
  const std::vector<SpaceClass> classes = classes_of(scene);
  for (const SpacePillar& one : scene.pillars) {
    const SpaceClass& kind = classes[static_cast<std::size_t>(one.of_class)];
    const double R_m = 0.5 * kind.diameter_m, above_m = kind.length_m - scene.length_m;
    if (finest_step_m(shape) > 4.0 * R_m / kRings) continue;
    const double reach_m = depth_m + above_m - lowest_node_m(shape, one.x_m, one.y_m, R_m);
    if (!(reach_m > 0.0)) continue;
    double seen_m = -HUGE_VAL;
    for (int ring = 1; ring <= kRings && seen_m < 0.5 * reach_m; ++ring) {
      const double r_m = R_m * (ring - 0.5) / kRings;
      for (int a = 0; a < kAngles; ++a) {
        const double angle = 2.0 * std::numbers::pi * a / kAngles;
        seen_m = std::max(seen_m, depth_m + above_m -
                                      height_m(shape, one.x_m + r_m * std::cos(angle),
                                               one.y_m + r_m * std::sin(angle)));
      }
    }
    if (seen_m >= 0.5 * reach_m) continue;
    throw SceneMistake("shape.file", "has a tip over pillar " + name_of({one.row, one.column}) +
                                         " that is narrower than the finest grid of its top, " +
                                         micrometres(R_m / kRings, 2) +
                                         "; give heights that are smooth over that length");
  }
}

FoundationPress foundation_press(const SpaceScene& scene) {
  return foundation_press(columns_under(scene), *scene.press, asks_for_map(scene, "release_depth"));
}

Eigen::Matrix<double, 1, kTopLoads> load_of(const TopPressure& top, double R_m) {
  Eigen::Matrix<double, 1, kTopLoads> load = Eigen::Matrix<double, 1, kTopLoads>::Zero();
  const double area_m2 = std::numbers::pi * R_m * R_m;
  load[static_cast<int>(TopLoad::kPressure)] = top.force_N / area_m2;
  const double of_moment = -1.0 / (0.25 * area_m2 * R_m);
  load[static_cast<int>(TopLoad::kTiltX)] = of_moment * top.moment_x_Nm;
  load[static_cast<int>(TopLoad::kTiltY)] = of_moment * top.moment_y_Nm;
  load[static_cast<int>(TopLoad::kShearX)] = top.shear_x_N / area_m2;
  load[static_cast<int>(TopLoad::kShearY)] = top.shear_y_N / area_m2;
  return load;
}

TopLoads loads_of_tops(const SpaceScene& scene, const std::vector<TopPressure>& tops,
                       const std::vector<std::size_t>& pillars) {
  TopLoads loads(static_cast<Eigen::Index>(tops.size()), kTopLoads);
  for (std::size_t i = 0; i < tops.size(); ++i) {
    const double d_m = class_of(scene, scene.pillars[pillars[i]]).diameter_m;
    loads.row(static_cast<Eigen::Index>(i)) = load_of(tops[i], 0.5 * d_m);
  }
  return loads;
}

double SpaceContact::largest_force_N() const {
  double largest_N = 0.0;
  for (const TopPressure& top : pressed.tops)
    largest_N = std::max(largest_N, std::abs(top.force_N));
  return largest_N;
}

}  // namespace viscard
