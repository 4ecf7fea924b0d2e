#pragma once

#include "io/config/config_fields.h"
#include "models/answer/scene_mistake.h"
#include "models/array/contact/rough_surface.h"
#include "models/material/material_causes.h"
#include "models/scene/scene.h"

#include <filesystem>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
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

// A material as a scene names it: a file, or an elastic one in place. A joint fit needs a mixing ratio.
struct NamedMaterial {
  std::string file;
  double ratio = 0.0;
  double E_Pa = 0.0, nu = 0.0, rho_kg_m3 = 0.0;
  Plausible judged = Plausible::kScene;  // the numbers of the file
  // Of a film; what is given replaces that of the file.
  double resistivity_Ohm_m = 0.0;                       // 0: not given
  std::vector<std::pair<double, double>> dielectric_s;  // time and added relative permittivity
};

// What a scene file names, and a scene holds only in its result.
struct SceneSources {
  std::filesystem::path folder;                    // in which files are looked for
  std::map<std::string, NamedMaterial> materials;  // by their names under [materials]
  std::string film;                                // name of its material
  bool film_is_reversed = false;                   // poling = "-z"
  bool film_is_directional = true;
  std::vector<std::string> of_classes;  // names of materials; empty: that of the usual pillars
  SpaceLattice lattice = SpaceLattice::kSquare;
  double spacing_m = 0.0;                    // of a lattice
  std::string positions, heights, voltages;  // tables
  RoughSurface rough;
};

// What stands in a scene file.
struct SceneFile {
  Scene scene;                            // every uncertain quantity at its value
  std::vector<UncertainField> uncertain;  // in the order they were read
  MaterialCauses material_causes;         // what the file of the pillars' material states
  ArraySweep sweep;                       // of rows of pillars; otherwise empty
  std::vector<PrintedValue> printed;      // [[printed]]
  SceneSources sources;
  bool row_is_called_array = false;  // kind = "array" of a row, which is "row" now
  std::string compare;               // another scene, in the folder of this one; empty: none
  bool accepts_implausible = false;  // the file, or who read it, says plausible = "off"
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

// The scene as TOML, which reads as the same scene.
std::string toml_of(SceneFile file);
// The keys that a scene of this kind may have, with what they may hold, and the entries of the lists that this one has:
// "geometry.film.thickness", "shape.at.2".
std::vector<FieldKey> keys_of(SceneFile file);

// The keys of scenes of every kind as tables in Markdown.
std::string table_of_scene_keys();

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
