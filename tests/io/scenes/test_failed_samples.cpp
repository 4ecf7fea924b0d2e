// Uncertain scenes that have no answer at some of their samples, and quantities whose spread is unknown.
#include "io/basics/atomic_file.h"
#include "io/basics/inputs.h"
#include "io/cli/scene/uncertainty_output.h"
#include "io/config/quantity_text.h"
#include "io/flow/scenes/answers_on_mesh.h"
#include "io/flow/scenes/scene_uncertainty.h"
#include "io/results/result_json.h"
#include "models/scene/simulate.h"
#include "tests/io/scenes/scene_text.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <new>
#include <optional>
#include <sstream>

using namespace viscard;
using namespace viscard::test;

namespace {

// A pressed pillar.
const char* const kPressed = R"(tolerance = 3e-2
[geometry]
diameter = "40 um"
length = "120 um"
[materials]
pillar = { E = "1.8 MPa", nu = 0.4 }
[analysis]
kind = "static"
load = { pressure = "10 kPa +- 1 %", on = "top" }
[want]
quantities = ["top_displacement"]
)";

SceneUncertainty uncertainty_in(const std::string& path, const UncertaintyOptions& options) {
  const SceneFile file = read_scene(path);
  const UncertainScene scene(file, read_file(path), path);
  SceneAnswer answer = simulate(file.scene);
  std::erase_if(answer.results, [](const SceneResult& r) { return r.name != "top_displacement"; });
  return scene_uncertainty(scene, answer, options);
}

}  // namespace

TEST_CASE("an unknown distribution is refused with those that are allowed",
          "[io][scenes][uncertainty]") {
  const SceneText text(replaced(kPressed, "\"1.8 MPa\"", "\"1.8 MPa +- 2 % gaussian\""));
  CHECK_THROWS_WITH(read_scene(text.path()),
                    Catch::Contains("materials.pillar.E") &&
                        Catch::Contains("\"gaussian\" is no distribution") &&
                        Catch::Contains("normal (the default), lognormal and uniform"));
  // A unit of another kind is no distribution.
  CHECK_THROWS_WITH(uncertain_from_text("40 um +- 1 kg", "m"), !Catch::Contains("distribution"));
}

TEST_CASE("samples beyond buckling widen an interval, and too many of them leave none",
          "[io][scenes][uncertainty]") {
  // The pillar buckles at 29.5 kPa.
  const SceneText few(replaced(kPressed, "10 kPa +- 1 %", "25 kPa +- 17 %"));
  const SceneUncertainty narrow = uncertainty_in(few.path(), {.n_samples = 100});
  const ResultUncertainty& moved = narrow.results.at(0);
  REQUIRE(narrow.is_sampled);
  CHECK(narrow.n_failed > 0);
  CHECK(narrow.failed_share > 0.0);
  CHECK(narrow.failed_share <= 0.025);
  CHECK(moved.no_interval.empty());
  CHECK(std::isfinite(moved.interval_95.low));
  CHECK_THAT(narrow.notes.back(), Catch::Contains("beyond either end"));
  const SceneText many(replaced(kPressed, "10 kPa +- 1 %", "27 kPa +- 20 %"));
  const SceneUncertainty wide = uncertainty_in(many.path(), {.n_samples = 100});
  const auto object = json_from_result(wide);
  CHECK(object["failed_share"] > 0.025);
  const auto printed = nlohmann::json::parse(object.dump());  // what is not finite is null there
  const auto& result = printed["results"][0];
  CHECK(result["interval_95"][0].is_null());
  CHECK(result["interval_95"][1].is_null());
  CHECK_THAT(result["no_interval"].get<std::string>(), Catch::Contains("2.5 %"));
  std::ostringstream people;
  print_uncertainty(wide, people);
  CHECK_THAT(people.str(), Catch::Contains("no interval: "));
}

TEST_CASE(
    "an uncertainty is not computed with a material that changed meanwhile, nor without memory",
    "[io][scenes][uncertainty]") {
  const SceneText text(
      replaced(kPressed, "{ E = \"1.8 MPa\", nu = 0.4 }", "{ file = \"soft.json\" }"));
  const auto write_material = [&](const char* E0_Pa) {
    std::ofstream(text.beside("soft.json"))
        << "{\"schema\": \"viscard-material/1\", \"E0_Pa\": " << E0_Pa
        << ", \"nu\": 0.4, \"terms\": []}\n";
  };
  write_material("1.8e6");
  const InputRecorder recorder;
  const SceneFile file = read_scene(text.path());
  const UncertainScene scene(file, read_file(text.path()), text.path());
  const SceneAnswer answer = simulate(file.scene);
  const std::function<void(double)> nobody;
  AnswerCount count(nobody);
  const AnswersOnMesh lacking(
      scene, named_values(answer), count,
      [](const Scene&) -> std::optional<SceneAnswer> { throw std::bad_alloc(); });
  CHECK_THROWS_AS(lacking(Eigen::MatrixXd::Zero(2, 1)), std::bad_alloc);
  write_material("0.9e6");
  CHECK_THROWS_AS(scene_uncertainty(scene, answer, {}), InputChanged);
}
