// Scene files with geometry.kind = "layer".
#include "tests/io/scenes/scene_text.h"
#include "tests/support/run_command.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

using namespace viscard;
using namespace viscard::test;
using Json = nlohmann::json;

namespace {

std::string layer_scene(const std::string& geometry, const std::string& shape,
                        const std::string& rest = "") {
  return R"(tolerance = 1e-2
[geometry]
kind = "layer"
thickness = "120 um"
film = { thickness = "25 um", material = "pvdf" }
)" + geometry +
         R"(
[materials]
layer = { E = "1.8 MPa", nu = 0.33 }
pvdf = { file = "DATA/materials/pvdf_seed.json" }
[shape]
)" + shape +
         "\n" + rest;
}

Json layer_answer(const std::string& text) {
  const SceneText scene(text);
  const CommandOutcome outcome = run_command({"simulate", scene.path(), "--json"});
  CAPTURE(outcome.err);
  REQUIRE(outcome.status == 0);
  return Json::parse(outcome.out);
}

std::string layer_refusal(const std::string& text) {
  const SceneText scene(text);
  const CommandOutcome outcome = run_command({"simulate", scene.path()});
  CHECK(outcome.status == 1);
  CHECK(outcome.out.empty());
  return outcome.err;
}

double layer_result(const Json& answer, const std::string& name) {
  return answer.at("results").at(name).at("value").get<double>();
}

const std::string kSphere = "kind = \"sphere\"\nradius = \"3650 um\"\ndepth = \"10 um\"";
const std::string kCylinder = "kind = \"cylinder\"\nradius = \"3650 um\"\ndepth = \"10 um\"";

}  // namespace

TEST_CASE("a layer of a scene file is pressed in space and in sections", "[cli][scene][layer]") {
  const Json space = layer_answer(
      layer_scene("electrode = { at = [[\"0 um\", \"0 um\"], [\"100 um\", \"0 um\"]] }", kSphere,
                  "[want]\nquantities = [\"contact_force\", \"mean_voltage_2\"]\n"));
  // Integral equation of the layer on a rigid base: 2.461489e-2 N; the film takes 1e-3.
  CHECK(layer_result(space, "contact_force") == Approx(2.461489e-2).epsilon(2e-3));
  CHECK(layer_result(space, "mean_voltage_2") < -0.7);
  CHECK(space.at("results").size() == 2);
  const Json stress = layer_answer(layer_scene("model = \"plane-stress\"", kCylinder));
  CHECK(layer_result(stress, "contact_force") == Approx(60.872).epsilon(1e-3));
  CHECK(stress.at("results").at("contact_force").at("unit") == "N/m");
  CHECK(layer_result(stress, "centre_voltage_1") == Approx(-0.90617).epsilon(1e-3));
  const Json strain = layer_answer(layer_scene("model = \"plane-strain\"", kCylinder));
  CHECK(layer_result(strain, "contact_force") == Approx(78.372).epsilon(1e-3));
  // The face follows the shape (finite elements: 40.471 N/m): another task than a shape that only pushes, as a note states.
  const Json follows = layer_answer(layer_scene("model = \"plane-stress\"\nwidth = \"740 um\"",
                                                kCylinder, "[effects]\ncontact = \"off\"\n"));
  CHECK(layer_result(follows, "contact_force") == Approx(40.471).epsilon(2e-3));
  CHECK(follows.at("within_tolerance").get<bool>());
  CHECK(follows.at("notes").dump().find("prescribes the motion") != std::string::npos);
}

TEST_CASE("a rough surface presses on a section of a layer", "[cli][scene][layer]") {
  const Json answer = layer_answer(
      layer_scene("model = \"plane-strain\"\nwidth = \"1 mm\"",
                  "kind = \"rough\"\nrms = \"0.25 um\"\ncorrelation_length = \"75 um\"\nseed = "
                  "3\nforce = \"2 N\"",
                  "[want]\nquantities = [\"contact_force\", \"contact_width\", \"depth\"]\n"));
  CHECK(layer_result(answer, "contact_force") == Approx(2.0).epsilon(1e-9));
  CHECK(layer_result(answer, "contact_width") > 50e-6);
  CHECK(layer_result(answer, "contact_width") < 950e-6);
  CHECK(std::abs(layer_result(answer, "depth")) < 1e-6);
}

TEST_CASE("curves of a layer are drawn over the place and over the wavelength",
          "[cli][scene][layer]") {
  const auto folder = std::filesystem::temp_directory_path() / "viscard_layer_curves";
  std::filesystem::remove_all(folder);
  const SceneText scene(layer_scene(
      "model = \"plane-strain\"\nwidth = \"1 mm\"",
      "kind = \"rough\"\nrms = \"0.25 um\"\ncorrelation_length = \"75 um\"\nforce = \"2 N\"",
      "[want]\nquantities = [\"pressure_profile\", \"gap_profile\", "
      "\"voltage_per_pressure\", \"blurring\", "
      "\"half_wavelength\"]\n"));
  const CommandOutcome outcome =
      run_command({"simulate", scene.path(), "--out", folder.string(), "--json"});
  CAPTURE(outcome.err);
  REQUIRE(outcome.status == 0);
  // Of another program, nu = 0.33: wavelength in plane strain along the stretch.
  const Json answer = Json::parse(outcome.out);
  CHECK(layer_result(answer, "half_wavelength") == Approx(293.4e-6).epsilon(1e-3));
  CHECK(layer_result(answer, "blurring") > 0.9);
  CHECK(layer_result(answer, "blurring") < 1.0);
  const auto text_of_file = [&](const std::string& name) {
    std::ifstream file(folder / name);
    return std::string(std::istreambuf_iterator<char>(file), {});
  };
  CHECK_THAT(text_of_file("pressure_profile.svg"), Catch::Contains("x (µm)"));
  CHECK_THAT(text_of_file("voltage_per_pressure.svg"), Catch::Contains("wavelength ("));
  CHECK_THAT(text_of_file("voltage_per_pressure.csv"), Catch::Contains("wavelength_m"));
  std::filesystem::remove_all(folder);
}

TEST_CASE("the plan of a layer lists the effects that it takes into account",
          "[cli][scene][layer]") {
  const SceneText scene(layer_scene("", kSphere));
  const CommandOutcome outcome = run_command({"plan", scene.path()});
  CHECK(outcome.status == 0);
  CHECK_THAT(outcome.out, Catch::Contains("contact"));
  CHECK_THAT(outcome.out, Catch::Contains("has no part in a layer"));
  CHECK_THAT(outcome.out, Catch::Contains("small strains are assumed"));
}

TEST_CASE("mistakes in the scene of a layer are named with their key", "[cli][scene][layer]") {
  CHECK_THAT(layer_refusal(layer_scene("", "")), Catch::Contains("needs a [shape]"));
  CHECK_THAT(layer_refusal(layer_scene("", "kind = \"plane\"\ndepth = \"1 um\"")),
             Catch::Contains("needs a width"));
  CHECK_THAT(layer_refusal(layer_scene("model = \"plane\"", kSphere)),
             Catch::Contains("geometry.model"));
  CHECK_THAT(layer_refusal(layer_scene("", kSphere, "[want]\nquantities = [\"mean_voltage_2\"]\n")),
             Catch::Contains("mean_voltage_2"));
  CHECK_THAT(layer_refusal(layer_scene(
                 "",
                 "kind = \"rough\"\nrms = \"1 um\"\ncorrelation_length = \"75 um\"\ndepth = "
                 "\"1 um\"")),
             Catch::Contains("needs a width"));
  CHECK_THAT(layer_refusal(layer_scene("", kSphere, "[effects]\ncontact = \"off\"\n")),
             Catch::Contains("contact"));
  CHECK_THAT(layer_refusal(layer_scene("", kSphere, "[analysis]\nkind = \"modal\"\n")),
             Catch::Contains("static"));
  CHECK_THAT(layer_refusal(layer_scene("spacing = \"60 um\"", kSphere)),
             Catch::Contains("spacing"));
}
