// The keys of scenes: one list for reading, writing and tables.
#include "io/basics/atomic_file.h"
#include "io/scenes/scene_file.h"
#include "models/scene/plan.h"
#include "tests/support/error_text.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <filesystem>
#include <set>
#include <string>

namespace viscard {
namespace {

const std::filesystem::path kScenes = VISCARD_SOURCE_DIR "/data/scenes";

// A number per effect, which follows from all lengths, moduli and loads of the scene.
std::vector<double> estimates_of(const Scene& scene) {
  std::vector<double> estimates;
  for (const SceneEffect& effect : plan_effects(scene).effects)
    estimates.push_back(effect.estimate);
  return estimates;
}

std::set<std::string> names(const SceneFile& file) {
  std::set<std::string> keys;
  for (const FieldKey& one : keys_of(file)) keys.insert(one.key);
  return keys;
}

}  // namespace

TEST_CASE("every example of a scene that is written reads as the same scene", "[io][scenes]") {
  int scenes = 0;
  for (const auto& entry : std::filesystem::directory_iterator(kScenes)) {
    if (entry.path().extension() != ".toml") continue;
    if (read_file(entry.path()).find("[geometry]") == std::string::npos) continue;
    CAPTURE(entry.path());
    const SceneFile file = read_scene(entry.path());
    const std::string text = toml_of(file);
    CAPTURE(text);
    const SceneFile again = scene_from_toml(text, entry.path());
    CHECK(again.scene.index() == file.scene.index());
    CHECK(toml_of(again) == text);
    CHECK(common(again.scene).wanted == common(file.scene).wanted);
    CHECK(common(again.scene).tolerance == common(file.scene).tolerance);
    const std::vector<double> first = estimates_of(file.scene), second = estimates_of(again.scene);
    REQUIRE(second.size() == first.size());
    for (std::size_t i = 0; i < first.size(); ++i) {
      CHECK(second[i] == Approx(first[i]).epsilon(1e-9));  // angles pass a tangent, forces an area
    }
    ++scenes;
  }
  CHECK(scenes >= 20);
}

TEST_CASE("the list of keys holds those of the kind, and the entries of lists that the scene has",
          "[io][scenes]") {
  const std::set<std::string> pillar = names(read_scene(kScenes / "pillar_sensor.toml"));
  for (const char* const key : {"tolerance", "geometry.film.thickness", "analysis.load.pressure",
                                "effects.relaxation", "want.quantities", "materials.pillar.nu"}) {
    CAPTURE(key);
    CHECK(pillar.count(key) == 1);
  }
  CHECK(pillar.count("shape.radius") == 0);
  const std::set<std::string> touch = names(read_scene(kScenes / "space_touch.toml"));
  CHECK(touch.count("geometry.classes.1.diameter") == 1);
  CHECK(touch.count("analysis.history.1.2") == 1);
  CHECK(touch.count("shape.radius") == 1);
}

TEST_CASE("every key of the examples stands in the table of keys", "[io][scenes]") {
  const std::string table = table_of_scene_keys();
  for (const char* const key :
       {"geometry.electrode.quadrants", "analysis.frequencies.from", "geometry.film.backing.nu",
        "shape.correlation_length", "heat.pillar.conductivity", "quadrants.neighbours",
        "noise.loss_tangent", "sweep.limit_percent", "geometry.width", "materials.layer.file",
        "discretisation.element_size", "readout.film_resistivity"}) {
    CAPTURE(key);
    CHECK(table.find("| `" + std::string(key) + "` |") != std::string::npos);
  }
  CHECK(table.find("one of: equipotential, sampled") != std::string::npos);
}

TEST_CASE("keys of surroundings that mean nothing without others are refused", "[io][scenes]") {
  const std::string scene = read_file(kScenes / "pillar_press.toml");
  const auto refusal = [&](const std::string& keys) {
    return test::error_text([&] {
      scene_from_toml(scene + "\n[surroundings]\n" + keys + "\n", kScenes / "pillar_press.toml");
    });
  };
  const auto contains = [](const std::string& text, const char* words) {
    return text.find(words) != std::string::npos;
  };
  CHECK(contains(refusal("made_at = \"23 degC\""), "need temperature and made_at"));
  CHECK(contains(refusal("temperature = \"33 degC\"\npillar_expansion = \"3e-4 1/K\""),
                 "need temperature and made_at"));
  CHECK(contains(refusal("temperature = \"33 degC\"\nmade_at = \"23 degC\""), "pillar_expansion"));
  CHECK(contains(refusal("air_density = \"1 kg/m3\""), "air = true"));
  CHECK(contains(refusal("temperature = \"33 degC +- 5 %\""), "no percentage"));
}

}  // namespace viscard
