#include "models/array/plane/array_scene.h"

#include "models/answer/drive_parts.h"

#include <numbers>

namespace viscard {

const Course& history(const ArrayScene& scene) {
  static const Course kNone;
  return *part_of(
      scene.drive, [](const auto& d) requires requires { d.history; } { return &d.history; },
      &kNone);
}

double slowest_rad_s(const ArrayScene& scene) {
  if (const auto* swept = std::get_if<RowHarmonic>(&scene.drive)) {
    return 2.0 * std::numbers::pi * swept->frequencies_Hz.front();
  }
  const auto* in_time = std::get_if<RowTransient>(&scene.drive);
  return in_time != nullptr ? 1.0 / in_time->end_time_s : 0.0;
}

bool is_electric(const ArrayScene& scene) {
  return scene.film.has_permittivity();
}

double place_m(const ArrayGeometry& geometry, int pillar) {
  return (pillar - 0.5 * (geometry.count - 1)) * (geometry.diameter_m + geometry.spacing_m);
}

PillarScene single_pillar(const ArrayScene& scene) {
  PillarScene one;
  one.tolerance = scene.tolerance;
  one.geometry.diameter_m = scene.geometry.diameter_m;
  one.geometry.length_m = scene.geometry.length_m;
  one.plane = scene.plane;
  one.pillar = scene.pillar;
  return one;
}

ArrayMedia media_of(const ArrayScene& scene) {
  return {isotropic_medium(scene.pillar.E0_Pa, scene.pillar.nu, scene.pillar.rho_kg_m3), scene.film,
          scene.plane};
}

}  // namespace viscard
