#pragma once

#include "io/basics/file_kind.h"
#include "io/basics/words.h"
#include "io/config/config_fields.h"
#include "io/materials/hyperelastic_file.h"
#include "io/materials/piezo_file.h"
#include "io/scenes/scene_file.h"
#include "models/answer/effect_estimate.h"
#include "models/answer/scene_mistake.h"
#include "models/material/material.h"

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace viscard {

// The readers of the kinds of scenes, and what they share.

// Reads the fields that `show` shows from an open scene file.
using FieldReader = std::function<void(const std::function<void(FieldVisitor&)>& show)>;

// Read a scene of one pillar, of a row, of an array in the plane, or of a layer; data/scenes/pillar_*.toml,
// array_*.toml, space_*.toml and layer_*.toml are commented examples. Material files are looked for in `folder`. Throw SceneMistake, std::invalid_argument or
// std::runtime_error for what is wrong.
void read_pillar(const FieldReader& read, const std::filesystem::path& folder, SceneFile& file);
void read_row(const FieldReader& read, const std::filesystem::path& folder, SceneFile& file);
void read_space(const FieldReader& read, const std::filesystem::path& folder, SceneFile& file);
void read_layer(const FieldReader& read, const std::filesystem::path& folder, SceneFile& file);

// The value of a word. Throws SceneMistake with the known words, and the nearest, for another.
template <typename Value>
Value choice(const std::string& key, const std::string& word,
             const std::map<std::string, Value>& all) {
  const auto found = all.find(word);
  if (found != all.end()) return found->second;
  std::vector<std::string> known;
  for (const auto& [name, value] : all) known.push_back(name);
  throw SceneMistake(
      key, "cannot be '" + word + "'" + did_you_mean(word, known) + " There are: " + listed(known));
}

// A material as it stands in a scene: a file, or an elastic one in place. A joint fit needs a mixing
// ratio.
struct RawMaterial {
  std::string file;
  double ratio = 0.0;
  double E_Pa = 0.0, nu = 0.0, rho_kg_m3 = 0.0;
  Plausible judged = Plausible::kScene;  // the numbers of the file
};
void show_material(FieldVisitor& v, RawMaterial& material);
void show_printed(FieldVisitor& v, std::vector<PrintedValue>& printed);

// Every wanted name must be one of the known ones. Throws SceneMistake with the nearest and all
// that are known.
void check_wanted(const std::vector<std::string>& wanted, const std::vector<std::string>& known);

// The same for an array in the plane: "mean_voltage" is a map with its largest and smallest value,
// "mean_voltage_3_4" the pillar in row 3 and column 4.
void check_space_wanted(const SpaceScene& scene);

// [effects]: name to "auto", "on", "off" or nothing. Throws SceneMistake.
EffectChoices choices_of(const std::map<std::string, std::string>& effects);

// The path of a file that a scene names at `key`. Throws SceneMistake, with what to do next, if it cannot be
// read. `folder`: that of the scene.
std::filesystem::path named_file(const std::string& key, const std::filesystem::path& folder,
                                 const std::string& name, FileKind wanted);

// The film. Throws SceneMistake if the material has neither a file nor a modulus, or is unphysical.
MediumFile film_medium(const std::string& key, const RawMaterial& raw,
                       const std::filesystem::path& folder);
// A file of rubber gives the modulus at rest and the terms; the scene gives nu and rho.
// The material that stands at `key`. Files are looked for in `folder`. Throws SceneMistake for neither file nor
// modulus.
Material pillar_material(const RawMaterial& raw, const std::filesystem::path& folder,
                         const std::string& key = "materials.pillar");
// What the material's file states if it is one of rubber, as `viscard fit uniaxial=FILE --out` writes it. Throws SceneMistake for one
// that is not to be trusted.
std::optional<HyperelasticFile> pillar_rubber(const RawMaterial& raw,
                                              const std::filesystem::path& folder,
                                              const std::string& key = "materials.pillar");

}  // namespace viscard
