#include "io/basics/atomic_file.h"
#include "io/config/config_fields.h"
#include "io/config/toml_text.h"
#include "io/materials/hyperelastic_file.h"
#include "io/materials/material_file.h"
#include "io/scenes/scene_fields.h"
#include "io/scenes/scene_file.h"
#include "models/material/ratio_causes.h"

#include <toml++/toml.h>

#include <algorithm>
#include <initializer_list>
#include <map>
#include <stdexcept>

namespace viscard {
namespace {

using Geometry = toml::node_view<const toml::node>;

bool has_any(const Geometry& geometry, std::initializer_list<const char*> keys) {
  return std::any_of(keys.begin(), keys.end(), [&](const char* key) { return !!geometry[key]; });
}

// Rows were called arrays, too: without the keys of an array in the plane a count, or a plane model, means a row.
std::string kind_in(const Geometry& geometry) {
  const bool has_count = has_any(geometry, {"count", "spacing"});
  const std::string kind =
      geometry["kind"].value_or(std::string(has_count ? "" : PillarScene::kKind));
  if (kind.empty()) {
    throw SceneMistake(
        "geometry",
        "has the count or spacing of a row of pillars; write kind = \"row\", or leave "
        "them out for a single one");
  }
  if (kind != SpaceScene::kKind || has_any(geometry, {"rows", "columns", "positions", "lattice"}))
    return kind;
  const std::string model = geometry["model"].value_or(std::string());
  if (model == SpaceScene::kModel) return kind;
  if (has_count || !model.empty()) return ArrayScene::kKind;
  throw SceneMistake(
      "geometry.kind",
      "is 'array', which has rows and columns, or positions; a row of pillars is kind = \"row\" "
      "with a count");
}

// geometry.kind decides which keys there are. A file that is not TOML counts as one of a pillar, whose reader
// reports what is wrong with it.
Scene empty_scene(const std::string& text, const std::filesystem::path& path) {
  std::string kind;
  try {
    const toml::table table = parsed_toml(text, path.string());
    kind = kind_in(table["geometry"]);
  } catch (const toml::parse_error&) {
    return PillarScene();
  }
  return choice<Scene>("geometry.kind", kind,
                       {{PillarScene::kKind, PillarScene()},
                        {ArrayScene::kKind, ArrayScene()},
                        {SpaceScene::kKind, SpaceScene()},
                        {LayerScene::kKind, LayerScene()}});
}

void show_scene(FieldVisitor& v, SceneFile& file) {
  std::visit([&](auto& scene) { show_fields(v, file, scene); }, file.scene);
}

// Why the material of the pillars is not known exactly. A joint fit states more than its material.
MaterialCauses material_causes(const SceneFile& file) {
  const bool is_layer = std::holds_alternative<LayerScene>(file.scene);
  const NamedMaterial& material = file.sources.materials.at(is_layer ? "layer" : "pillar");
  const std::filesystem::path named = file.sources.folder / material.file;
  if (!material.file.empty() && material.ratio > 0.0) {
    return causes_at_ratio(read_ratio_fit(named, Plausible::kOff), material.ratio);
  }
  if (material.file.empty() || !looks_like_hyperelastic_file(named)) {
    return causes_of(common(file.scene).pillar);
  }
  return {
      .causes = {},
      .left_out =
          "the errors of the parameters of the law of rubber are not propagated; results vary with "
          "the other uncertain values alone"};
}

std::string with_line(const std::string& text, const std::filesystem::path& path,
                      const SceneMistake& mistake) {
  const int line = line_of_key(text, mistake.key());
  return path.string() + ":" + std::to_string(line) + ": " + mistake.key() + ": " + mistake.what();
}

}  // namespace

SceneFile read_scene(const std::filesystem::path& path, Plausible judged) {
  return scene_from_toml(read_file(path), path, {}, judged);
}

SceneFile scene_from_toml(const std::string& text, const std::filesystem::path& path,
                          const std::map<std::string, double>& values, Plausible judged) {
  SceneFile file{.sources = {.folder = path.parent_path()}};
  const ChooseValue choose = [&](const UncertainField& field) {
    const auto is_it = [&](const UncertainField& one) { return one.key == field.key; };
    if (std::none_of(file.uncertain.begin(), file.uncertain.end(), is_it)) {
      file.uncertain.push_back(field);
    }
    const auto given = values.find(field.key);
    return given == values.end() ? field.number.value : given->second;
  };
  try {
    read_as(FileKind::kScene, text, path.string(), [&] {
      file.scene = empty_scene(text, path);
      const auto show = [&](FieldVisitor& v) { show_scene(v, file); };
      file.accepts_implausible =
          read_toml_fields(text, path.string(), show, {.plausible = judged, .choose = choose}) ||
          judged == Plausible::kOff;
    });
    // Those who give values know the causes already.
    if (values.empty()) file.material_causes = material_causes(file);
  } catch (const SceneMistake& mistake) {
    throw std::runtime_error(with_line(text, path, mistake));
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(path.string() + ": " + error.what());
  }
  return file;
}

std::string toml_of(SceneFile file) {
  return toml_from_fields([&](FieldVisitor& v) { show_scene(v, file); }, Empty::kLeftOut);
}

std::vector<FieldKey> keys_of(SceneFile file) {
  return keys_of_fields([&](FieldVisitor& v) { show_scene(v, file); });
}

std::string table_of_scene_keys() {
  const std::pair<const char*, Scene> kKinds[] = {
      {"One pillar", PillarScene()},
      {"A row of pillars, geometry.kind = \"row\"", ArrayScene()},
      {"An array in the plane, geometry.kind = \"array\"", SpaceScene()},
      {"A layer, geometry.kind = \"layer\"", LayerScene()}};
  std::string text =
      "# Keys of scene files\n\nA film's material stands under [materials] with the name that "
      "geometry.film.material gives, here pvdf.\n";
  for (const auto& [kind, scene] : kKinds) {
    text += std::string("\n## ") + kind + "\n\n| key | holds |\n|---|---|\n";
    for (const FieldKey& one : keys_of({.scene = scene, .sources = {.film = "pvdf"}})) {
      text += "| `" + one.key + "` | " + one.holds + " |\n";
    }
  }
  return text;
}

std::string text_with_line(const std::filesystem::path& path, const SceneMistake& mistake) {
  return with_line(read_file(path), path, mistake);
}

}  // namespace viscard
