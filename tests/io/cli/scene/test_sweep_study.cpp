#include "io/basics/atomic_file.h"
#include "io/flow/sweep/run_study.h"
#include "io/scenes/scene_file.h"
#include "tests/io/scenes/scene_text.h"
#include "tests/support/run_command.h"

#include <nlohmann/json.hpp>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>

using namespace viscard;
using namespace viscard::test;

namespace {

const char* const kPressedScene = R"(tolerance = 1e-2
[geometry]
diameter = "40 um"
length = "120 um"
[materials]
pillar = { E = "1.8 MPa", nu = 0.33 }
[analysis]
kind = "static"
load = { pressure = "1 kPa", on = "top" }
[want]
quantities = ["top_displacement"]
)";

const char* const kStudy = R"(scene = "scene.toml"
[[parameter]]
key = "geometry.diameter"
from = "30 um"
to = "50 um"
count = 6
[[parameter]]
key = "materials.pillar.nu"
values = ["0.3", "0.4", "-1"]
[[parameter]]
key = "analysis.load.pressure"
from = "100 Pa"
to = "1000 Pa"
count = 5
spacing = "log"
)";

// A study beside its scene.
struct StudyFiles {
  SceneText scene{kPressedScene};
  std::string study = scene.beside("study.toml");
  explicit StudyFiles(const std::string& text = kStudy) { write_file(study, text, false); }
};

std::string table_of(const StudyFiles& files, const std::vector<std::string>& words) {
  const std::string table = files.scene.beside("table.csv");
  std::vector<std::string> all{"sweep", files.study, "--csv", table, "--force"};
  all.insert(all.end(), words.begin(), words.end());
  const CommandOutcome outcome = run_command(all);
  CAPTURE(outcome.err);
  REQUIRE(outcome.status == 0);
  return read_file(table);
}

}  // namespace

TEST_CASE("a study combines its values, the first parameter slowest", "[cli][scene][sweep]") {
  const StudyFiles files;
  const Study study = read_study(files.study);
  REQUIRE(count_points(study) == 90);
  CHECK(values_at(study, 0)[0].second == "30 um");
  CHECK(values_at(study, 89)[0].second == "50 um");
  CHECK(values_at(study, 7)[1].second == "0.4");
  CHECK(values_at(study, 2)[2].second.rfind("316.2277", 0) == 0);  // the middle of a log range
  const SceneFile file =
      scene_from_toml(scene_text_with(study, values_at(study, 75)), study.scene_path);
  CHECK(std::get<PillarScene>(file.scene).geometry.diameter_m == Approx(50e-6).epsilon(1e-12));
}

TEST_CASE("a sweep that is killed five times ends with each point once", "[cli][scene][sweep]") {
  const StudyFiles files;
  const std::string whole = table_of(files, {"--out", files.scene.beside("whole.sqlite")});
  const std::string cut = files.scene.beside("cut.sqlite");
  const Study study = read_study(files.study);
  for (std::size_t kills = 1; kills <= 5; ++kills) {
    const pid_t child = fork();
    if (child == 0) {
      run_command({"sweep", files.study, "--out", cut});
      _exit(0);
    }
    // Killed as soon as some more points are there.
    while (waitpid(child, nullptr, WNOHANG) == 0) {
      usleep(500);
      if (std::filesystem::exists(cut) && StudyStore(cut, study).done().size() >= 12 * kills) {
        kill(child, SIGKILL);
        waitpid(child, nullptr, 0);
        break;
      }
    }
    CHECK(StudyStore(cut, study).done().size() >= 12 * kills);
  }
  CHECK(table_of(files, {"--out", cut}) == whole);
  CHECK(whole.find("nu") != std::string::npos);  // a point with -1 has no answer, and says why
}

TEST_CASE("parts of a sweep give the same rows bit for bit", "[cli][scene][sweep]") {
  const StudyFiles files;
  const std::string whole = table_of(files, {"--out", files.scene.beside("whole.sqlite")});
  std::vector<std::string> words{"--out", files.scene.beside("all.sqlite")};
  for (const char* const number : {"1", "2", "3"}) {
    const std::string part = files.scene.beside(std::string("part") + number + ".sqlite");
    REQUIRE(
        run_command({"sweep", files.study, "--out", part, "--shard", std::string(number) + "/3"})
            .status == 0);
    words.insert(words.end(), {"--merge", part});
  }
  CHECK(table_of(files, words) == whole);
}

TEST_CASE("mistakes in a study are reported before anything is answered", "[cli][scene][sweep]") {
  struct Case {
    const char* from;
    const char* to;
    const char* what;
  };
  const auto c = GENERATE(Case{"geometry.diameter", "geometry.diametre", "diametre"},
                          Case{"geometry.diameter", "nowhere.diameter", "nowhere"},
                          Case{"\"50 um\"", "\"50 mm\"", "same unit"},
                          Case{"count = 6", "count = 1", "count"});
  const StudyFiles files(replaced(kStudy, c.from, c.to));
  const CommandOutcome outcome =
      run_command({"sweep", files.study, "--out", files.scene.beside("x.sqlite")});
  CAPTURE(outcome.err);
  CHECK(outcome.status == 1);
  CHECK(outcome.err.find(c.what) != std::string::npos);
  CHECK(run_command({"sweep", files.study, "--shard", "4/3"}).status == 2);
}

TEST_CASE("answers of a study cannot be kept in a folder, in no folder or in another file",
          "[cli][scene][sweep]") {
  const StudyFiles files(kStudy);
  const std::string folder = std::filesystem::path(files.study).parent_path().string();
  const auto error_with = [&](const std::string& out) {
    const CommandOutcome outcome = run_command({"sweep", files.study, "--out", out});
    CHECK(outcome.status == 1);
    return outcome.err;
  };
  CHECK(error_with(folder).find("is a folder; name a file in it, such as ") != std::string::npos);
  CHECK(error_with(folder + "/none/x").find("there is no folder '" + folder + "/none'") !=
        std::string::npos);
  const std::string table = files.scene.beside("table.csv");
  write_file(table, "time_s,force_N\n0,1\n", false);
  CHECK(error_with(table).find("is not an SQLite database") != std::string::npos);
}
