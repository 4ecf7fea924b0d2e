#pragma once

#include "io/config/config_fields.h"
#include "models/array/quadrants/quadrant_gains.h"
#include "models/array/space/space_scene.h"

#include <cstdint>
#include <filesystem>
#include <string>

namespace viscard {

// The section [quadrants] of an array in the plane before it is checked.
struct RawQuadrants {
  std::string voltages;  // file of measured voltages
  std::string neighbours = "deconvolved", averages = "area";
  std::int64_t circles = 8, on_circle = 29;  // of averages = "nodes"
  double noise_V = 0.0;
};

// [quadrants]: voltages, neighbours, averages, circles, on_circle, noise.
void show_quadrants(FieldVisitor& quadrants_table, RawQuadrants& raw);

// Kind of electrode from geometry.electrode, and whether it is in quarters. Throws SceneMistake for
// an impossible combination.
SpaceElectrode electrode_from(const std::string& kind, bool in_quarters);

// How the scene, which has its pillars, finds forces from voltages. Throws SceneMistake or, for a file that cannot be
// read, std::runtime_error.
void fill_quadrants(const RawQuadrants& raw, const std::filesystem::path& folder,
                    SpaceScene& scene);

}  // namespace viscard
