#include "io/basics/atomic_file.h"
#include "io/config/config_fields.h"
#include "io/config/toml_text.h"
#include "io/materials/hyperelastic_file.h"
#include "io/materials/material_file.h"
#include "io/scenes/scene_file.h"
#include "io/scenes/scene_words.h"
#include "models/material/ratio_causes.h"

#include <toml++/toml.h>

#include <algorithm>
#include <map>
#include <stdexcept>

namespace viscard {
namespace {

using SceneReader = void (*)(const FieldReader& read, const std::filesystem::path& folder,
                             SceneFile& file);

// By geometry.kind.
const std::map<std::string, SceneReader>& readers() {
  static const std::map<std::string, SceneReader> kReaders = {{PillarScene::kKind, read_pillar},
                                                              {ArrayScene::kKind, read_row},
                                                              {LayerScene::kKind, read_layer}};
  return kReaders;
}

// An array in the plane shares its kind with rows; the model distinguishes them.
bool is_in_space(const toml::node_view<const toml::node>& geometry, const std::string& kind) {
  if (kind != SpaceScene::kKind) return false;
  if (geometry["model"].value_or(std::string()) == SpaceScene::kModel) return true;
  for (const char* const key : {"rows", "columns", "positions"}) {
    if (!geometry[key]) continue;
    throw SceneMistake(std::string("geometry.") + key,
                       "belongs to an array in the plane; say model = \"space\" (a row has a "
                       "count)");
  }
  return false;
}

// geometry.kind decides how the rest is read. A file that is not TOML goes to the reader of
// pillars, which reports what is wrong with it.
SceneReader reader_for(const std::string& text, const std::filesystem::path& path) {
  std::string kind;
  bool is_space = false;
  try {
    const toml::table table = parsed_toml(text, path.string());
    const toml::node_view<const toml::node> geometry = table["geometry"];
    const bool has_count = geometry["count"] || geometry["spacing"];
    kind = geometry["kind"].value_or(std::string(has_count ? "" : PillarScene::kKind));
    is_space = is_in_space(geometry, kind);
  } catch (const toml::parse_error&) {
    return read_pillar;
  }
  if (kind.empty()) {
    throw SceneMistake("geometry",
                       "has the count or spacing of a row of pillars; say kind = "
                       "\"array\", or leave them out for a single one");
  }
  if (is_space) return read_space;
  return choice<SceneReader>("geometry.kind", kind, readers());
}

// Settings of the computation, and requested points, are exact.
void refuse_uncertain(const std::string& key) {
  for (const char* const exact : {"tolerance", "discretisation.", "sweep.", "analysis.frequencies",
                                  "analysis.end_time", "materials.pillar.ratio"}) {
    if (key.rfind(exact, 0) != 0) continue;
    throw std::invalid_argument("has no uncertainty; leave out what stands behind +-");
  }
}

// Why the material of the pillars is not known exactly. A joint fit states more than its material.
MaterialCauses material_causes(const std::string& text, const std::filesystem::path& path,
                               const Scene& scene) {
  const toml::table table = parsed_toml(text, path.string());
  const char* const key = std::holds_alternative<LayerScene>(scene) ? "layer" : "pillar";
  const toml::node_view<const toml::node> material = table["materials"][key];
  const auto ratio = material["ratio"].value<double>();
  const auto file = material["file"].value<std::string>();
  if (!file) return causes_of(common(scene).pillar);
  const std::filesystem::path named = path.parent_path() / *file;
  if (ratio) return causes_at_ratio(read_ratio_fit(named, Plausible::kOff), *ratio);
  if (!looks_like_hyperelastic_file(named)) return causes_of(common(scene).pillar);
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
  SceneFile file;
  const ChooseValue choose = [&](const UncertainField& field) {
    refuse_uncertain(field.key);
    const auto is_it = [&](const UncertainField& one) { return one.key == field.key; };
    if (std::none_of(file.uncertain.begin(), file.uncertain.end(), is_it)) {
      file.uncertain.push_back(field);
    }
    const auto given = values.find(field.key);
    return given == values.end() ? field.number.value : given->second;
  };
  const FieldReader read = [&](const std::function<void(FieldVisitor&)>& show) {
    file.accepts_implausible =
        read_toml_fields(text, path.string(), show, {.plausible = judged, .choose = choose}) ||
        judged == Plausible::kOff;
  };
  try {
    read_as(FileKind::kScene, text, path.string(),
            [&] { reader_for(text, path)(read, path.parent_path(), file); });
    // Those who give values know the causes already.
    if (values.empty()) file.material_causes = material_causes(text, path, file.scene);
  } catch (const SceneMistake& mistake) {
    throw std::runtime_error(with_line(text, path, mistake));
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(path.string() + ": " + error.what());
  }
  return file;
}

std::string text_with_line(const std::filesystem::path& path, const SceneMistake& mistake) {
  return with_line(read_file(path), path, mistake);
}

}  // namespace viscard
