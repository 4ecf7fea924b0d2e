// Scenes whose pillar is of a law of rubber.
#include "io/scenes/scene_file.h"
#include "models/scene/plan.h"
#include "models/scene/simulate.h"
#include "tests/support/scratch_folder.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

using namespace viscard;
using viscard::test::ScratchFolder;

namespace {

const std::string kFile = VISCARD_SOURCE_DIR "/data/materials/treloar_yeoh.json";

std::string scene_with(const std::string& pillar) {
  return "tolerance = 1e-2\n[geometry]\ndiameter = \"100 um\"\nlength = \"100 um\"\n"
         "[materials]\npillar = { " +
         pillar +
         " }\n[analysis]\nkind = \"static\"\nload = { displacement = \"-5 um\", on = \"top\" }\n";
}

PillarScene pillar_of(const std::string& text) {
  return std::get<PillarScene>(scene_from_toml(text, "scene.toml").scene);
}

}  // namespace

TEST_CASE("a pillar's material may be a law of rubber", "[io][plan]") {
  const PillarScene scene =
      pillar_of(scene_with("file = \"" + kFile + "\", nu = 0.49, rho = \"930 kg/m3\""));
  REQUIRE(scene.rubber);
  CHECK(scene.rubber->form == HyperelasticForm::kYeoh);
  // 6 C10 of the file.
  CHECK(scene.pillar.E0_Pa == Approx(6.0 * 184633.24060406964).epsilon(1e-12));
  CHECK(scene.pillar.nu == 0.49);
  CHECK(scene.pillar.rho_kg_m3 == 930.0);
}

TEST_CASE("a law of rubber in a scene needs nu and no modulus", "[io]") {
  CHECK_THROWS_WITH(pillar_of(scene_with("file = \"" + kFile + "\"")), Catch::Contains("needs nu"));
  CHECK_THROWS_WITH(pillar_of(scene_with("file = \"" + kFile + "\", nu = 0.49, E = \"1 MPa\"")),
                    Catch::Contains("leave out E"));
  CHECK_THROWS_WITH(pillar_of(scene_with("file = \"" + kFile + "\", nu = 0.6")),
                    Catch::Contains("Poisson ratio"));
}

namespace {

// A file of a law with two terms, as viscard fit --terms 2 writes it.
std::string relaxing_file(const ScratchFolder& folder) {
  const std::filesystem::path path = folder / "two.json";
  std::ofstream(path) << R"({"schema": "viscard-hyperelastic/1", "law": "neo-hooke", "laws": [
    {"name": "neo-hooke", "parameters": [{"name": "C10_Pa", "value": 3e5}], "trustworthy": true,
     "terms": [{"g": 0.15, "tau_s": 0.3}, {"g": 0.25, "tau_s": 8.0}], "flags": []}], "tests": []})";
  return path.string();
}

// A file of a law with damage, as viscard fit --model neo-hooke+mullins-or writes it.
std::string damaged_law_file(const ScratchFolder& folder) {
  const std::filesystem::path path = folder / "damaged.json";
  std::ofstream(path) << R"({"schema": "viscard-hyperelastic/1", "law": "neo-hooke", "laws": [
    {"name": "neo-hooke", "parameters": [{"name": "C10_Pa", "value": 3e5}], "trustworthy": true,
     "damage": {"name": "mullins-or", "parameters": [{"name": "r", "value": 1.6},
     {"name": "m_Pa", "value": 1e5}, {"name": "beta", "value": 0}]}, "flags": []}], "tests": []})";
  return path.string();
}

double value_of(const SceneAnswer& answer, const std::string& name) {
  for (const SceneResult& result : answer.results) {
    if (result.name == name) return result.value;
  }
  return std::nan("");
}

std::string notes_of(const PillarScene& scene) {
  std::string all;
  for (const std::string& note : simulate(scene).notes) all += note + "\n";
  return all;
}

}  // namespace

TEST_CASE("a law of rubber with damage is refused by scenes, with the way on", "[io][mullins]") {
  const ScratchFolder folder;
  CHECK_THROWS_WITH(pillar_of(scene_with("file = \"" + damaged_law_file(folder) + "\", nu = 0.49")),
                    Catch::Contains("scenes do not compute") &&
                        Catch::Contains("viscard fit --model neo-hooke --cycle N"));
}

TEST_CASE("a foam is refused by scenes", "[io][foam]") {
  const ScratchFolder folder;
  const std::filesystem::path path = folder / "foam.json";
  std::ofstream(path) << R"({"schema": "viscard-hyperelastic/1", "law": "hyperfoam-1", "laws": [
    {"name": "hyperfoam-1", "parameters": [{"name": "mu_1_Pa", "value": 5e4}, {"name": "alpha_1",
     "value": 8}, {"name": "nu", "value": 0.2}], "trustworthy": true, "flags": []}], "tests": []})";
  CHECK_THROWS_WITH(pillar_of(scene_with("file = \"" + path.string() + "\", nu = 0.2")),
                    Catch::Contains("holds a foam"));
}

TEST_CASE("the terms of a law of rubber relax the pillar", "[io][plan]") {
  const ScratchFolder folder;
  const PillarScene creep = pillar_of(
      "tolerance = 1e-4\n[geometry]\ndiameter = \"40 um\"\nlength = \"120 um\"\n"
      "[materials]\npillar = { file = \"" +
      relaxing_file(folder) +
      "\", nu = 0.499 }\n"
      "[analysis]\nkind = \"creep\"\n"
      "history = [[\"0 s\", \"10 kPa\"], [\"20 s\", \"10 kPa\"]]\n");
  REQUIRE(creep.pillar.terms.size() == 2);
  CHECK(creep.pillar.E0_Pa == Approx(1.8e6).epsilon(1e-12));
  CHECK(creep.pillar.terms[1].g == 0.25);
  CHECK(creep.pillar.terms[1].k == 0.25);
  CHECK(creep.pillar.terms[1].tau_s == 8.0);
  // E0 J at 20 s for E/E0 = 0.6 + 0.15 exp(-t/0.3 s) + 0.25 exp(-t/8 s), from the two poles of 1/(s^2 E(s)): at
  // constant nu every displacement grows as it does.
  PillarScene elastic = creep;
  elastic.pillar.terms.clear();
  const double grown = value_of(simulate(creep), "top_displacement_end") /
                       value_of(simulate(elastic), "top_displacement_end");
  CHECK(grown == Approx(1.581622).epsilon(1e-3));
}

TEST_CASE("large strain says that the terms of a law of rubber do not count", "[io][plan]") {
  const ScratchFolder folder;
  PillarScene pressed =
      pillar_of(scene_with("file = \"" + relaxing_file(folder) + "\", nu = 0.49"));
  const std::string at_once = "the relaxation of its file does not count";
  CHECK_THAT(notes_of(pressed), Catch::Contains(at_once));
  pressed.pillar.terms.clear();
  CHECK_THAT(notes_of(pressed), !Catch::Contains(at_once));
}

TEST_CASE("the example of large strain is answered at large strain", "[io][plan]") {
  const Scene scene = read_scene(VISCARD_SOURCE_DIR "/data/scenes/pillar_large.toml").scene;
  const SceneAnswer answer = simulate(scene);
  CHECK(answer.within_tolerance);
  for (const SceneEffect& effect : answer.effects) {
    if (effect.name == "finite_strain") CHECK(effect.on);
  }
  Scene linear = scene;
  common(linear).effects["finite_strain"] = EffectChoice::kOff;
  const SceneAnswer straight = simulate(linear);
  const auto force_N = [](const SceneAnswer& one) {
    for (const SceneResult& result : one.results) {
      if (result.name == "top_force") return result.value;
    }
    return 0.0;
  };
  // At 10 % of compression the law's nominal stress is 11 % above E0 times the strain, and the
  // clamped ends add to it.
  const double ratio = force_N(answer) / force_N(straight);
  CAPTURE(force_N(answer), force_N(straight));
  CHECK(ratio > 1.08);
  CHECK(ratio < 1.25);
}
