#include "io/basics/atomic_file.h"
#include "tests/io/scenes/scene_text.h"
#include "tests/support/run_command.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <fstream>
#include <sstream>

using namespace viscard;
using namespace viscard::test;

TEST_CASE("the design of the thesis' sensor is printed with its limits", "[cli][design]") {
  const CommandOutcome outcome = run_command(
      {"design", "--diameter", "40 um", "--spacing", "60 um", "--length", "120 um", "--json"});
  REQUIRE(outcome.status == 0);
  const auto design = nlohmann::json::parse(outcome.out);
  CHECK(design["admissible"].get<bool>());
  // Square lattice: 4/pi 2.5^2; buckling at K = 1: 149.4 um; matting at gamma = .02: 434.4 um.
  CHECK(design["stress_concentration"].get<double>() == Approx(7.958).epsilon(1e-4));
  for (const auto& limit : design["limits"]) {
    if (limit["name"] == "buckling")
      CHECK(limit["limit"].get<double>() == Approx(149.4e-6).epsilon(1e-3));
    if (limit["name"] == "matting")
      CHECK(limit["limit"].get<double>() == Approx(434.4e-6).epsilon(1e-3));
  }
}

TEST_CASE("a design that cannot be is refused in one line", "[cli][design]") {
  struct Case {
    std::vector<std::string> words;
    const char* what;
  };
  const auto c = GENERATE(
      Case{{"--end-factor", "3"}, "end"}, Case{{"--end-factor", "0"}, "end"},
      Case{{"--diameter", "-1 um"}, "diameter"}, Case{{"--diameter", "40 kg"}, "--diameter"},
      Case{{"--poisson", "0.6"}, "--poisson is 0.6"},
      Case{{"--lattice", "sqare"}, "did you mean 'square'"}, Case{{"--modulus", "0"}, "modulus"},
      Case{{"--diameter", "40"}, "--diameter is 40 m; plausible are 0 to 1 m"},
      Case{{"--diameter", "40 m"}, "write --diameter \"40 um\""},
      Case{{"--spacing", "-1um"}, "--spacing is -1um; it must be positive"},
      Case{{"--aspect-ratio", "-2"}, "--aspect-ratio is -2; it must be positive"},
      Case{{"--sensitivity", "x"}, "expected a plain number; write it like 0.05"},
      Case{{"--nonsense", "1"}, "nonsense"});
  CAPTURE(c.words[0], c.words[1]);
  std::vector<std::string> words = {"design"};
  words.insert(words.end(), c.words.begin(), c.words.end());
  const CommandOutcome outcome = run_command(words);
  CAPTURE(outcome.err);
  CHECK(outcome.status == 2);
  CHECK(outcome.out.empty());
  CHECK(outcome.err.find(c.what) != std::string::npos);
}

TEST_CASE("the command judges a scene, fails unless all pass, and keeps to 80 columns",
          "[cli][design]") {
  const std::string hand = VISCARD_SOURCE_DIR "/data/requirements/human_hand.toml";
  const std::string scene = std::string(VISCARD_SOURCE_DIR "/data/scenes/pillar_sensor.toml");
  const CommandOutcome outcome = run_command({"design", scene, "--require", hand});
  CHECK(outcome.status == 1);
  std::istringstream lines(outcome.out);
  std::string line;
  std::getline(lines, line);  // the file
  while (std::getline(lines, line)) {
    CAPTURE(line);
    CHECK(line.size() <= 80);
  }
  CHECK(outcome.out.find("not answered") != std::string::npos);
  const SceneText easy(
      "[require]\nlargest_pressure = \"10 kPa\"\nvoltage_per_pressure = \"1 mV/kPa\"\n");
  const CommandOutcome passed = run_command({"design", scene, "--require", easy.path(), "--json"});
  CAPTURE(passed.out);
  CHECK(passed.status == 0);
  const auto object = nlohmann::json::parse(passed.out);
  CHECK(object["passes"].get<bool>());
  // Of the scene's own answer at 10 kPa.
  const auto simulated = nlohmann::json::parse(run_command({"simulate", scene, "--json"}).out);
  const double volts = std::abs(simulated["results"]["electrode_voltage"]["value"].get<double>());
  CHECK(object["lines"][1]["value"].get<double>() == Approx(volts / 10e3).epsilon(2e-3));
  CHECK(run_command({"design", scene}).status == 2);
  CHECK(run_command({"design", "--require", hand}).status == 2);
  CHECK(run_command({"design", scene, "--require", hand, "--length", "1 um"}).status == 2);
  CHECK(run_command({"design", "--tol", "1e-3"}).status == 2);
  const CommandOutcome idle = run_command({"design", "--search-time", "5s"});
  CHECK(idle.status == 2);
  CHECK_THAT(idle.err, Catch::Contains("--search-time is for a scene"));
  CHECK(run_command({"design", scene, "--require", easy.path(), "--tol", "5"}).status == 2);
  CHECK(run_command({"design", "/nowhere.toml", "--require", hand}).status == 1);
}

TEST_CASE("the command writes a front between two objectives that simulate reads",
          "[cli][design]") {
  const SceneText scene(R"(tolerance = 1e-2
[geometry]
diameter = "40 um"
length = "120 um"
[materials]
pillar = { E = "1.8 MPa", nu = 0.33, rho = "965 kg/m3" }
[analysis]
kind = "buckling"
)");
  std::ofstream(scene.beside("spec.toml")) << R"(scene = "scene.toml"
front = 4
[require]
collapse_margin = 1.5
[[range]]
key = "geometry.length"
from = "100 um"
to = "2000 um"
[[objective]]
quantity = "collapse_margin"
goal = "largest"
[[objective]]
quantity = "geometry.length"
goal = "largest"
)";
  const std::string out = scene.beside("designed");
  const CommandOutcome outcome =
      run_command({"design", scene.beside("spec.toml"), "--out", out, "--json"});
  CAPTURE(outcome.err);
  REQUIRE(outcome.status == 0);
  const auto designs = nlohmann::json::parse(outcome.out)["designs"];
  REQUIRE(designs.size() == 4);
  for (std::size_t i = 1; i < designs.size(); ++i) {
    CHECK(designs[i]["objectives"][0]["value"] < designs[i - 1]["objectives"][0]["value"]);
    CHECK(designs[i]["objectives"][1]["value"] > designs[i - 1]["objectives"][1]["value"]);
  }
  CHECK(run_command({"design", scene.beside("spec.toml"), "--tol", "1e-3"}).status == 2);
  CHECK(run_command({"design", scene.beside("spec.toml"), "--search-time", "5s"}).status == 2);
  CHECK(run_command({"simulate", out + "/scene_1.toml"}).status == 0);
  CHECK(read_file(out + "/front.svg").find("<svg") != std::string::npos);
}
