#include "io/basics/atomic_file.h"
#include "io/flow/scenes/array_sweep.h"
#include "models/scene/plan.h"
#include "tests/io/scenes/scene_text.h"
#include "tests/support/run_command.h"

#include <nlohmann/json.hpp>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>

using namespace viscard;
using namespace viscard::test;

namespace {

const char* const kMap = R"(tolerance = 1e-3
[geometry]
kind = "array"
count = 1
diameter = "40 um"
length = "120 um"
spacing = "60 um"
film = { thickness = "25 um", ends = "mirror", material = "pvdf" }
[materials]
pillar = { E = "1.8 MPa", nu = 0.33, rho = "965 kg/m3" }
pvdf = { file = "DATA/materials/pvdf_seed.json" }
[analysis]
kind = "static"
load = { pressure = "1 kPa", on = "top" }
[sweep]
diameter = ["20 um", "30 um", "40 um"]
spacing = ["40 um", "50 um", "60 um", "80 um"]
length_over_diameter = 3
[want]
quantities = ["centre_voltage", "deviation_percent"]
)";

// The table without its first line, which tells the command and with it the folder.
std::string rows_of(const std::filesystem::path& folder) {
  const std::string text = read_file(folder / "sweep.csv");
  return text.substr(text.find('\n'));
}

}  // namespace

TEST_CASE("the answer of a sweep holds each effect's largest estimate over the points",
          "[cli][scene][array]") {
  const SceneText scene(kMap);
  const CommandOutcome outcome = run_command({"simulate", scene.path(), "--json"});
  REQUIRE(outcome.status == 0);
  const SceneFile file = read_scene(scene.path());
  std::map<std::string, double> largest;
  for (const SweepPoint& point : points_of(std::get<ArrayScene>(file.scene), file.sweep)) {
    for (const SceneEffect& effect : plan_effects(point.scene).effects) {
      largest[effect.name] = std::max(largest[effect.name], effect.estimate);
    }
  }
  const nlohmann::json answer = nlohmann::json::parse(outcome.out);
  int checked = 0;
  for (const auto& effect : answer["effects"]) {
    if (!effect["estimate"].is_number()) continue;
    CAPTURE(effect["name"]);
    CHECK(effect["estimate"] == largest.at(effect["name"]));
    ++checked;
  }
  CHECK(checked > 2);
}

TEST_CASE("a sweep that was killed goes on and gives the same table", "[cli][scene][array]") {
  const SceneText scene(kMap);
  const std::string whole = scene.beside("whole");
  REQUIRE(run_command({"simulate", scene.path(), "--out", whole}).status == 0);
  const std::filesystem::path cut = scene.beside("cut");
  const std::filesystem::path part = cut / "sweep.part.csv";
  const pid_t child = fork();
  if (child == 0) {
    run_command({"simulate", scene.path(), "--out", cut.string()});
    _exit(0);
  }
  // Killed as soon as two points are there.
  const auto lines = [&] {
    std::ifstream in(part);
    return std::count(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>(), '\n');
  };
  while (lines() < 3 && waitpid(child, nullptr, WNOHANG) == 0) usleep(1000);
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  REQUIRE(std::filesystem::exists(part));
  std::ofstream(part, std::ios::app) << "7,centre_voltage_1,-0.0";  // a line that was cut off
  const CommandOutcome outcome = run_command({"simulate", scene.path(), "--out", cut.string()});
  CAPTURE(outcome.err);
  REQUIRE(outcome.status == 0);
  CHECK(outcome.err.find("continuing: ") != std::string::npos);
  CHECK(rows_of(cut) == rows_of(whole));
  CHECK_FALSE(std::filesystem::exists(part));
}

TEST_CASE("points of another sweep are not taken over", "[cli][scene][array]") {
  const SceneText scene(kMap);
  const std::filesystem::path folder = scene.beside("other");
  {
    SweepStore store(folder, "sweep of another scene");
    store.add(0, {{"centre_voltage_1", 1.0, "V"}});
  }
  const CommandOutcome outcome = run_command({"simulate", scene.path(), "--out", folder.string()});
  CHECK(outcome.status == 1);
  CHECK(outcome.err.find("another sweep") != std::string::npos);
}

TEST_CASE(
    "the first spacing below a limit has the error of the table, and a note on a change of sign",
    "[cli][scene][array]") {
  const auto first_of = [](const std::vector<std::pair<double, double>>& deviations) {
    ArraySweep sweep;
    std::vector<SweepPoint> points;
    std::map<std::size_t, SweepRow> rows;
    for (const auto& [percent, error] : deviations) {
      ArrayScene scene;
      scene.geometry.spacing_m = 10e-6 * static_cast<double>(points.size() + 5);  // from 50 um
      sweep.spacing_m.push_back(scene.geometry.spacing_m);
      rows[points.size()] = {{"deviation_percent_1", percent, "%", error}};
      points.push_back({scene, "spacing"});
    }
    sweep.limit_percent = 0.1;
    return joined(sweep, points, rows);
  };
  const auto result = [](const SceneAnswer& answer, const std::string& name) {
    const auto found = std::find_if(answer.results.begin(), answer.results.end(),
                                    [&](const SceneResult& r) { return r.name == name; });
    return found == answer.results.end() ? SceneResult{} : *found;
  };
  // Decays: the limit is crossed between 60 and 70 um.
  const SceneAnswer decays = first_of({{.4, .01}, {.2, .01}, {.06, .01}, {.02, .01}});
  CHECK(result(decays, "first_spacing").value == Approx(70e-6));
  CHECK(result(decays, "first_spacing").error_estimate == Approx(10e-6));
  CHECK(result(decays, "settled_spacing").name.empty());
  CHECK(decays.notes.empty());
  // 60 um may be below already and 70 um may not: it is 80 um at most.
  const SceneAnswer close = first_of({{.4, .01}, {.101, .01}, {.099, .01}, {.02, .01}});
  CHECK(result(close, "first_spacing").value == Approx(70e-6));
  CHECK(result(close, "first_spacing").error_estimate == Approx(20e-6));
  // Passes through 0 at about 60 um.
  const SceneAnswer turns = first_of({{.4, .01}, {.03, .01}, {-.15, .01}, {-.05, .01}});
  CHECK(result(turns, "first_spacing").value == Approx(60e-6));
  CHECK(result(turns, "settled_spacing").value == Approx(80e-6));
  REQUIRE(turns.notes.size() == 1);
  CHECK(turns.notes[0].find("changes sign") != std::string::npos);
  CHECK(turns.notes[0].find("-0.15 % at 70 um") != std::string::npos);
  // Nothing of the table is wide enough.
  const SceneAnswer never = first_of({{.4, .01}, {.03, .01}, {-.15, .01}});
  CHECK(result(never, "settled_spacing").name.empty());
  REQUIRE(never.notes.size() == 1);
  CHECK(never.notes[0].find("no spacing of the sweep") != std::string::npos);
  // Everything is: anywhere between 0 and 50 um.
  CHECK(result(first_of({{.01, .001}, {.0, .001}}), "first_spacing").error_estimate ==
        Approx(50e-6));
}
