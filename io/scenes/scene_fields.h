#pragma once

#include "io/basics/file_kind.h"
#include "io/basics/words.h"
#include "io/config/config_fields.h"
#include "io/materials/hyperelastic_file.h"
#include "io/materials/piezo_file.h"
#include "io/scenes/scene_file.h"
#include "models/answer/scene_mistake.h"
#include "models/array/contact/rough_surface.h"

#include <filesystem>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace viscard {

// One function for each kind of scene shows all of its keys; reading, writing and lists of keys follow from it.
// A key whose value the scene holds as it stands is shown as that member. Keys that decide something together are
// shown as a small struct, made from the scene, which goes into the scene after_all_keys(). Throw SceneMistake,
// std::invalid_argument or std::runtime_error for what is wrong.
void show_fields(FieldVisitor& v, SceneFile& file, PillarScene& scene);
void show_fields(FieldVisitor& v, SceneFile& file, ArrayScene& scene);
void show_fields(FieldVisitor& v, SceneFile& file, SpaceScene& scene);
void show_fields(FieldVisitor& v, SceneFile& file, LayerScene& scene);

// A positive length.
QuantityField length_key(const char* key, bool is_required = false);

// The parts that the kinds share.
// tolerance, compare, [effects], [want] and [[printed]].
void show_common(FieldVisitor& v, const char* wanted_example, SceneFile& file);
// [materials] with `body`, "pillar" or "layer", those of the film and of classes, and what `others` shows. The
// scene gets the material of the body.
void show_materials(FieldVisitor& v, const char* body, SceneFile& file,
                    const std::function<void(FieldVisitor&)>& others = {});
// geometry.film.material and geometry.poling, of kinds that always have a film; it goes to `film`.
void show_film_material(FieldVisitor& film_table, SceneFile& file);
void show_poling(FieldVisitor& geometry_table, SceneFile& file);
Medium film_of(const SceneFile& file);

// An entry of shape.path. NaN: not given.
struct PathStop {
  double time_s = 0.0, x_m = 0.0, y_m = 0.0;
  double depth_m = std::numeric_limits<double>::quiet_NaN();
  double force_N = std::numeric_limits<double>::quiet_NaN();
};
using ShapePath = std::vector<PathStop>;

// [shape]. `now`: what is written; null: no shape. `place` gets a shape that is read; it acts on what is touchable, over
// which a rough surface, without end, is drawn. `path`: of a shape that may move, written and read; null: it may not.
void show_shape(FieldVisitor& v, SceneFile& file, const ShapePress* now,
                const std::function<RoughExtent()>& touchable,
                const std::function<void(const ShapePress&)>& place,
                const std::shared_ptr<ShapePath>& path = nullptr);

// The face that is grounded, by that of the electrode.
const WordTable<FilmFace>& grounded_by_electrode_face();
// geometry.electrode of an array in the plane or a layer: face, kind, quadrants, radius and, where quarters may be of
// metal, the gap between them.
void show_electrode(FieldVisitor& electrode_table, FilmFace& grounded, SpaceElectrode& electrode,
                    double& radius_m, double* gap_m = nullptr);

// The value of a word. Throws SceneMistake with the known words, and the nearest, for another.
template <typename Value>
Value choice(const std::string& key, const std::string& word, const WordTable<Value>& all) {
  const auto found = all.find(word);
  if (found != all.end()) return found->second;
  std::vector<std::string> known;
  for (const auto& [name, value] : all) known.push_back(name);
  throw SceneMistake(
      key, "cannot be '" + word + "'" + did_you_mean(word, known) + " There are: " + listed(known));
}

// Every wanted name must be one of the known ones. Throws SceneMistake with the nearest and all
// that are known.
void check_wanted(const std::vector<std::string>& wanted, const std::vector<std::string>& known);

// The path of a file that a scene names at `key`. Throws SceneMistake, with what to do next, if it cannot be
// read.
std::filesystem::path named_file(const std::string& key, const SceneFile& file,
                                 const std::string& name, FileKind wanted);

// The film's material under `name`. Throws SceneMistake if it has neither a file nor a modulus, or is unphysical.
MediumFile film_medium(const SceneFile& file, const std::string& name);
// What the film's material states of its losses, into the scene. Throws SceneMistake for terms without a permittivity.
void set_film_loss(SceneFile& file);
// A material under `name`. A file of rubber gives the modulus at rest and the terms; the scene gives nu and rho. Throws
// SceneMistake for neither file nor modulus.
Material pillar_material(const SceneFile& file, const std::string& name);
// Multiplies the material's relaxation times by its shift factor at the scene's temperature, and returns the factor: 1
// without a temperature, without a shift or without terms. Throws SceneMistake where the shift law has no value.
double bring_to_temperature(const SceneFile& file, Material& material);
// What the material's file states if it is one of rubber, as `viscard fit uniaxial=FILE --out` writes it. Throws
// SceneMistake for one that is not to be trusted.
std::optional<HyperelasticFile> pillar_rubber(const SceneFile& file, const std::string& name);

}  // namespace viscard
