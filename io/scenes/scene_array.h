#pragma once

#include "io/basics/printed_value.h"
#include "models/array/plane/array_scene.h"

#include <filesystem>
#include <string>
#include <vector>

namespace viscard {

// Every combination of these; an empty list stands for the scene's own value.
struct ArraySweep {
  std::vector<double> diameter_m, spacing_m, thickness_m;
  double length_over_diameter = 0.0;  // 0: the scene's length whatever the diameter
  double limit_percent = 0.0;         // deviation below which the first spacing is told; 0: no
  bool is_empty() const { return diameter_m.empty() && spacing_m.empty() && thickness_m.empty(); }
};

// One combination; `label` names what varies: "diameter 40 um, spacing 60 um".
struct SweepPoint {
  ArrayScene scene;
  std::string label;
};

struct ArraySceneFile {
  ArrayScene scene;
  ArraySweep sweep;
  std::vector<PrintedValue> printed;
};

// geometry.kind of a scene file, "pillar" if it does not say or cannot be read as TOML (the reader
// of that kind then tells why). Throws std::runtime_error if there is no such file, the kind is
// another word, or there is none though pillars are counted.
std::string scene_kind(const std::filesystem::path& path);

// A scene with kind = "array"; data/scenes/array_*.toml are commented examples. Throws
// std::runtime_error with file:line, key and what is expected.
ArraySceneFile read_array_scene(const std::filesystem::path& path);

// Diameters slowest, spacings fastest.
std::vector<SweepPoint> points_of(const ArraySceneFile& file);

}  // namespace viscard
