#include "models/pillar/scene/pillar_scene.h"

#include "models/answer/drive_parts.h"

#include <numbers>

namespace viscard {
namespace {

constexpr auto kReadHistory = [](const auto& d) requires requires {
  d.history;
}
{ return &d.history; };

}  // namespace

LoadPlace load_place(const PillarScene& scene) {
  return part_of(
      scene.drive, [](const auto& d) requires requires { d.load_place; } { return d.load_place; },
      LoadPlace::kTop);
}

bool is_lateral(const PillarScene& scene) {
  return part_of(
             scene.drive,
             [](const auto& d) requires requires { d.direction; } { return d.direction; },
             LoadDirection::kAxial) == LoadDirection::kLateral;
}

double pressure_Pa(const PillarScene& scene) {
  return part_of(
      scene.drive, [](const auto& d) requires requires { d.pressure_Pa; } { return d.pressure_Pa; },
      0.0);
}

std::optional<double> displacement_m(const PillarScene& scene) {
  return part_of(
      scene.drive,
      [](const auto& d) requires requires { d.displacement_m; } { return d.displacement_m; },
      std::optional<double>());
}

bool moves_top(const PillarScene& scene) {
  return displacement_m(scene).has_value();
}

bool reads_quadrants(const PillarScene& scene) {
  return is_lateral(scene) && scene.electrodes && scene.electrodes->quadrants;
}

double base_acceleration_m_s2(const PillarScene& scene) {
  return part_of(
      scene.drive, [](const auto& d) requires requires { d.base_acceleration_m_s2; } {
        return d.base_acceleration_m_s2;
      },
      0.0);
}

double drive_V(const PillarScene& scene) {
  return part_of(
      scene.drive, [](const auto& d) requires requires { d.drive_V; } { return d.drive_V; }, 0.0);
}

bool plate_on_top(const PillarScene& scene) {
  return part_of(
      scene.drive,
      [](const auto& d) requires requires { d.plate_on_top; } { return d.plate_on_top; }, false);
}

bool has_history(const PillarScene& scene) {
  return has_part(scene.drive, kReadHistory);
}

const Course& history(const PillarScene& scene) {
  static const Course kNone;
  return *part_of(scene.drive, kReadHistory, &kNone);
}

double slowest_rad_s(const PillarScene& scene) {
  const double lowest_Hz = part_of(
      scene.drive, [](const auto& d) requires requires { d.frequencies_Hz; } {
        return d.frequencies_Hz.front();
      },
      0.0);
  if (lowest_Hz > 0.0) return 2.0 * std::numbers::pi * lowest_Hz;
  const double end_s = part_of(
      scene.drive, [](const auto& d) requires requires { d.end_time_s; } { return d.end_time_s; },
      has_history(scene) ? history(scene).back().time_s : 0.0);
  return end_s > 0.0 ? 1.0 / end_s : 0.0;
}

double free_face_m(const PillarScene& scene) {
  const bool is_top = scene.electrodes->grounded == FilmFace::kBottom;
  return is_top ? 0.0 : -scene.geometry.film->thickness_m;
}

}  // namespace viscard
