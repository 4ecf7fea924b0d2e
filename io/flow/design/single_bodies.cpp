#include "io/flow/design/single_bodies.h"

#include "models/array/space/space_maps.h"
#include "models/pillar/system/rotated_medium.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace viscard {
namespace {

constexpr double kSamePlace = 1e-6;  // of the pitch

// Effects are planned anew: an effect chosen for the scene may not exist in another analysis.
void strip(PillarScene& one) {
  one.electrodes.reset();
  one.readout.reset();
  one.wanted.clear();
  one.effects.clear();
  one.progress = nullptr;
  one.discretisation.reset();
}

std::optional<PillarScene> body_of(const PillarScene& scene) {
  PillarScene one = scene;
  strip(one);
  return one;
}

std::optional<PillarScene> body_of(const ArrayScene& row) {
  PillarScene one = single_pillar(row);
  one.film = row.film;
  one.geometry.film = FilmGeometry{row.geometry.film_thickness_m,
                                   0.5 * (row.geometry.diameter_m + row.geometry.spacing_m)};
  return one;
}

std::optional<PillarScene> body_of(const SpaceScene& array) {
  PillarScene one = single_pillar(array, {array.diameter_m, array.length_m, array.pillar});
  one.film = averaged_about_z(array.film);
  one.geometry.film = FilmGeometry{array.film_thickness_m, 0.5 * smallest_pitch_m(array)};
  return one;
}

std::optional<PillarScene> body_of(const LayerScene&) {
  return std::nullopt;
}

// Rows that are shifted by half a pitch.
bool is_hexagonal(const SpaceScene& array, double pitch_m) {
  const SpacePillar& first = array.pillars.front();
  return std::any_of(array.pillars.begin(), array.pillars.end(), [&](const SpacePillar& other) {
    const double dx = std::abs(other.x_m - first.x_m), dy = std::abs(other.y_m - first.y_m);
    return std::abs(dx - 0.5 * pitch_m) < kSamePlace * pitch_m &&
           std::abs(dy - 0.5 * std::numbers::sqrt3 * pitch_m) < kSamePlace * pitch_m;
  });
}

}  // namespace

std::optional<PillarScene> single_body(const Scene& scene) {
  return std::visit([](const auto& body) { return body_of(body); }, scene);
}

std::optional<double> pitch_of(const Scene& scene) {
  if (const auto* row = std::get_if<ArrayScene>(&scene)) {
    return row->geometry.diameter_m + row->geometry.spacing_m;
  }
  const auto* array = std::get_if<SpaceScene>(&scene);
  if (array == nullptr || array->pillars.size() < 2) return std::nullopt;
  return smallest_pitch_m(*array);
}

std::optional<double> cell_area_m2(const Scene& scene) {
  const auto* array = std::get_if<SpaceScene>(&scene);
  if (array == nullptr || array->pillars.size() < 2) return std::nullopt;
  const double pitch_m = smallest_pitch_m(*array);
  if (is_hexagonal(*array, pitch_m)) return 0.5 * std::numbers::sqrt3 * pitch_m * pitch_m;
  if (square_pitch_m(*array) > 0.0) return pitch_m * pitch_m;
  return std::nullopt;
}

std::optional<double> pressure_share(const Scene& scene) {
  if (std::holds_alternative<PillarScene>(scene)) return 1.0;
  if (const auto* row = std::get_if<ArrayScene>(&scene)) {
    return 1.0 + row->geometry.spacing_m / row->geometry.diameter_m;
  }
  const auto cell_m2 = cell_area_m2(scene);
  if (!cell_m2) return std::nullopt;
  const double d_m = std::get<SpaceScene>(scene).diameter_m;
  return *cell_m2 / (0.25 * std::numbers::pi * d_m * d_m);
}

std::optional<std::size_t> middle_pillar(const SpaceScene& scene) {
  double x_m = 0.0, y_m = 0.0;
  for (const SpacePillar& one : scene.pillars) {
    x_m += one.x_m / static_cast<double>(scene.pillars.size());
    y_m += one.y_m / static_cast<double>(scene.pillars.size());
  }
  std::optional<std::size_t> nearest;
  double least_m = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < scene.pillars.size(); ++i) {
    const SpacePillar& one = scene.pillars[i];
    const double away_m = std::hypot(one.x_m - x_m, one.y_m - y_m);
    if (one.of_class != 0 || !(away_m < least_m)) continue;
    least_m = away_m;
    nearest = i;
  }
  return nearest;
}

}  // namespace viscard
