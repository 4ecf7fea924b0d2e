#pragma once

#include "io/config/config_fields.h"
#include "models/answer/scene_mistake.h"
#include "models/material/material_causes.h"
#include "models/scene/scene.h"

#include <filesystem>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace viscard {

// Values that a sweep over rows of pillars combines; an empty list means the scene's own value.
struct ArraySweep {
  std::vector<double> diameter_m, spacing_m, thickness_m;
  double length_over_diameter = 0.0;  // 0: the scene's length at every diameter
  // The first spacing whose deviation lies below this is reported; 0: none.
  double limit_percent = 0.0;
  // True if no value varies.
  bool is_empty() const { return diameter_m.empty() && spacing_m.empty() && thickness_m.empty(); }
};

// The value that a publication prints for one result of a scene. Commands print it beside ours.
struct PrintedValue {
  std::string name;   // of a result, or family and number of a mode: "lateral 2"
  std::string value;  // with its unit: "16103 Hz"
  std::string note;   // why our value differs
};

// What stands in a scene file.
struct SceneFile {
  Scene scene;                            // every uncertain quantity at its value
  std::vector<UncertainField> uncertain;  // in the order they were read
  MaterialCauses material_causes;         // what the file of the pillars' material states
  ArraySweep sweep;                       // of rows of pillars; otherwise empty
  std::vector<PrintedValue> printed;      // [[printed]]
  bool accepts_implausible = false;       // the file, or who read it, says plausible = "off"
};

// Scene files are TOML; data/scenes/ holds commented examples. Material files are looked for in the
// folder of the scene. Throws std::runtime_error with file:line, key and what is expected, or with
// the name of a bad material file.
SceneFile read_scene(const std::filesystem::path& path, Plausible judged = Plausible::kScene);
// The same from text; messages show `path`, whose folder holds the material files. Uncertain quantities
// named in `values` take these values (SI).
SceneFile scene_from_toml(const std::string& text, const std::filesystem::path& path,
                          const std::map<std::string, double>& values = {},
                          Plausible judged = Plausible::kScene);

// One combination; `label` names what varies: "diameter 40 um, spacing 60 um".
struct SweepPoint {
  ArrayScene scene;
  std::string label;
};

// Every combination of the sweep, diameters slowest, spacings fastest.
std::vector<SweepPoint> points_of(const ArrayScene& scene, const ArraySweep& sweep);

// "file:line: key: what".
std::string text_with_line(const std::filesystem::path& path, const SceneMistake& mistake);

// Works on a scene of the file. A mistake found there becomes std::runtime_error with its line.
template <typename Work>
auto with_lines_of(const std::filesystem::path& path, const Work& work) {
  try {
    return work();
  } catch (const SceneMistake& mistake) {
    throw std::runtime_error(text_with_line(path, mistake));
  }
}

}  // namespace viscard
