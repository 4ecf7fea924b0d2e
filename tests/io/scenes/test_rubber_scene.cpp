// Scenes whose pillar is of a law of rubber.
#include "io/scenes/scene_file.h"
#include "models/scene/plan.h"
#include "models/scene/simulate.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <string>

using namespace viscard;

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
