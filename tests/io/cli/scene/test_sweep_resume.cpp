#include "io/basics/atomic_file.h"
#include "io/cli/scene/sweep_run.h"
#include "io/flow/scenes/array_sweep.h"
#include "io/flow/sweep/study_store.h"
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

namespace {

// The scene above with its film's material beside it, and the store of the points that are done.
struct MapFiles {
  SceneText scene{replaced(kMap, "DATA/materials/pvdf_seed.json", "pvdf.json")};
  std::string film = scene.beside("pvdf.json");
  std::filesystem::path folder = scene.beside("out"), part = folder / kPartOfSweep;
  MapFiles() {
    std::filesystem::copy_file(VISCARD_SOURCE_DIR "/data/materials/pvdf_seed.json", film);
    std::filesystem::create_directories(folder);
  }
  Study study() const { return study_of_sweep(read_scene(scene.path()), scene.path()); }
  // As if the first n of the 12 points had been answered with these numbers.
  void add_points(std::int64_t n) const {
    StudyStore store(part, study());
    for (std::int64_t point = 0; point < n; ++point) {
      store.add(StudyPoint{.point = point,
                           .values = {{"point", "x"}},
                           .results = {{"centre_voltage_1", 1.25, "V", 0.0},
                                       {"deviation_percent_1", 0.5, "%", 0.0},
                                       {"unknowns", 1e6, "1", 0.0},
                                       {"degree", 9.0, "1", 0.0},
                                       {"layers", 3.0, "1", 0.0}}});
    }
  }
  CommandOutcome simulate(std::vector<std::string> more = {}) const {
    std::vector<std::string> words{"simulate", scene.path(), "--out", folder.string()};
    words.insert(words.end(), more.begin(), more.end());
    return run_command(words);
  }
};

}  // namespace

TEST_CASE("a sweep that was killed goes on and gives the same table", "[cli][scene][array]") {
  const MapFiles files;
  const std::string whole = files.scene.beside("whole");
  REQUIRE(run_command({"simulate", files.scene.path(), "--out", whole}).status == 0);
  const pid_t child = fork();
  if (child == 0) {
    files.simulate();
    _exit(0);
  }
  // Killed as soon as two points are there.
  const Study study = files.study();
  const auto is_begun = [&] {
    return std::filesystem::exists(files.part) && StudyStore(files.part, study).done().size() >= 2;
  };
  while (!is_begun() && waitpid(child, nullptr, WNOHANG) == 0) usleep(1000);
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  REQUIRE(std::filesystem::exists(files.part));
  const CommandOutcome outcome = files.simulate();
  CAPTURE(outcome.err);
  REQUIRE(outcome.status == 0);
  CHECK(outcome.err.find("continuing: ") != std::string::npos);
  CHECK(rows_of(files.folder) == rows_of(whole));
  CHECK_FALSE(std::filesystem::exists(files.part));
}

TEST_CASE("a sweep that goes on gives mesh and effects of all its points", "[cli][scene][array]") {
  const MapFiles files;
  const CommandOutcome whole = run_command({"simulate", files.scene.path(), "--json"});
  REQUIRE(whole.status == 0);
  files.add_points(11);
  const CommandOutcome outcome = files.simulate({"--json"});
  CAPTURE(outcome.err);
  REQUIRE(outcome.status == 0);
  CHECK(outcome.err.find("continuing: 11 of 12 points are done") != std::string::npos);
  const auto answer = nlohmann::json::parse(outcome.out);
  CHECK(answer["effects"] == nlohmann::json::parse(whole.out)["effects"]);
  CHECK(answer["unknowns"] == 1'000'000);
  CHECK(answer["discretisation"]["degree"] == 9);
  CHECK(rows_of(files.folder).find("1.25,") != std::string::npos);
}

TEST_CASE("points of another scene, material or tolerance are not taken over",
          "[cli][scene][array]") {
  const MapFiles files;
  files.add_points(2);
  const int changed = GENERATE(0, 1, 2);
  if (changed == 0) std::ofstream(files.scene.path(), std::ios::app) << "\n";
  if (changed == 1) std::ofstream(files.film, std::ios::app) << "\n";
  const CommandOutcome outcome =
      changed == 2 ? files.simulate({"--tol", "2e-3"}) : files.simulate();
  CAPTURE(outcome.err);
  CHECK(outcome.status == 1);
  CHECK(outcome.err.find(kPartOfSweep) != std::string::npos);
  CHECK(outcome.err.find(changed == 1 ? "pvdf.json has changed since"
                                      : "points of another study") != std::string::npos);
  CHECK(outcome.err.find("choose another folder with --out") != std::string::npos);
  CHECK_FALSE(std::filesystem::exists(files.folder / "sweep.csv"));
}

TEST_CASE("a number that was altered among the points that are done is answered again",
          "[cli][scene][array]") {
  const MapFiles files;
  files.add_points(1);
  Database(files.part, Database::Access::kReadWrite)
      .execute("UPDATE points SET results = replace(results, '1.25', '1.75')");
  const CommandOutcome outcome = files.simulate();
  CAPTURE(outcome.err);
  CHECK(outcome.status == 0);
  CHECK(outcome.err.find("1 row damaged; their points are answered again") != std::string::npos);
  CHECK(outcome.err.find("continuing") == std::string::npos);
  CHECK(rows_of(files.folder).find("1.75,") == std::string::npos);
}

TEST_CASE("a second sweep in the same folder is refused until the first has ended",
          "[cli][scene][array]") {
  const MapFiles files;
  const StudyLock first(files.part, nullptr);
  const CommandOutcome outcome = files.simulate();
  CHECK(outcome.status == 1);
  CHECK(outcome.err.find("another sweep is answering its points") != std::string::npos);
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
      rows[points.size()].results = {{"deviation_percent_1", percent, "%", error}};
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
