#include "io/basics/atomic_file.h"
#include "io/flow/sweep/run_study.h"
#include "io/scenes/scene_file.h"
#include "tests/io/cli/scene/study_files.h"
#include "tests/support/error_text.h"
#include "tests/support/run_command.h"
#include "tests/support/scratch_folder.h"

#include <sys/wait.h>
#include <toml++/toml.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>

using namespace viscard;
using namespace viscard::test;

namespace {

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

TEST_CASE("a parameter may be an entry of a list of the scene", "[cli][scene][sweep]") {
  const std::string scene =
      "[shape]\nat = [\"1 um\", \"2 um\"]\ntilt = [0.5, \"0 degree\"]\n"
      "[analysis]\nhistory = [[\"0 s\", \"0 N\"], [\"1 s\", \"5 N\"]]\n"
      "[[geometry.classes]]\ndiameter = \"30 um\"\n";
  const auto with = [&](const std::string& key, const std::string& value) {
    return scene_text_with(scene, "scene.toml", {{key, value}});
  };
  const auto read = [](const std::string& text) { return toml::parse(text); };
  const auto at = read(with("shape.at.2", "-7 um"));
  CHECK(at["shape"]["at"][0].value<std::string>() == "1 um");
  CHECK(at["shape"]["at"][1].value<std::string>() == "-7 um");
  CHECK(read(with("shape.tilt.1", "0.25"))["shape"]["tilt"][0].value<double>() == 0.25);
  const auto history = read(with("analysis.history.2.1", "3 s"));
  CHECK(history["analysis"]["history"][1][0].value<std::string>() == "3 s");
  CHECK(history["analysis"]["history"][1][1].value<std::string>() == "5 N");
  CHECK(read(with("geometry.classes.1.diameter", "9 um"))["geometry"]["classes"][0]["diameter"]
            .value<std::string>() == "9 um");
  CHECK_THROWS_WITH(with("shape.at.3", "1 um"), Catch::Contains("that has 2 in the scene"));
  CHECK_THROWS_WITH(with("shape.at.0", "1 um"), Catch::Contains("counted from 1"));
  CHECK_THROWS_WITH(with("shape.at.x", "1 um"), Catch::Contains("counted from 1"));
  CHECK_THROWS_WITH(with("shape.before.1", "1 um"), Catch::Contains("no section or list"));
  CHECK_THROWS_WITH(with("analysis.history.5.1", "1 s"), Catch::Contains("no section or list"));
}

TEST_CASE("values take the places of those of the scene, so that all lines keep their numbers",
          "[cli][scene][sweep]") {
  const std::string begin = GENERATE("", "\xEF\xBB\xBF");
  const std::string scene = begin +
                            "tolerance = 1e-3  # of \"all\"\r\n[geometry]\n"
                            "\"diameter\"= '40 \u00b5m'# \u00b5\nlength = \"\u00b5\"\n"
                            "film = { a = \"\u00b5\", thickness = \"25 um\", b = +2_0 }\n"
                            "at = [\n  1,# one\n  0x10 ]\nnote = \"\"\"\ntwo\nlines\"\"\" # end\n"
                            "last = true";
  const auto with = [&](const StudyValues& values) {
    return scene_text_with(scene, "scene.toml", values);
  };
  CHECK(with({{"tolerance", "0.5"},
              {"geometry.diameter", "9 \u00b5m"},
              {"geometry.film.thickness", "a \"b\""},
              {"geometry.film.b", "3"},
              {"geometry.at.2", "1 um"},
              {"geometry.note", "x"},
              {"geometry.last", "y"}}) ==
        begin +
            "tolerance = 0.5  # of \"all\"\r\n[geometry]\n"
            "\"diameter\"= '9 \u00b5m'# \u00b5\nlength = \"\u00b5\"\n"
            "film = { a = \"\u00b5\", thickness = 'a \"b\"', b = 3.0 }\n"
            "at = [\n  1,# one\n  '1 um' ]\nnote = 'x' # end\n"
            "last = 'y'");
  // A key that the scene lacks.
  const auto added = toml::parse(with({{"geometry.film.c", "1"}, {"geometry.at.1", "2"}}));
  CHECK(added["geometry"]["film"]["c"].value<double>() == 1.0);
  CHECK(added["geometry"]["at"][0].value<double>() == 2.0);
}

TEST_CASE("a parameter in a section that the scene lacks is refused with the key that was meant",
          "[cli][scene][sweep]") {
  const auto error = [](const char* key) {
    const std::string scene =
        "[geometry]\ndiameter = \"40 um\"\nlength = \"120 um\"\n[analysis]\nkind = \"modal\"\n"
        "[materials]\npillar = { E = \"1.8 MPa\", nu = 0.33, rho = \"965 kg/m3\" }\n";
    return test::error_text([&] { scene_text_with(scene, "scene.toml", {{key, "1"}}); });
  };
  CHECK(error("geometri.diameter").find("did you mean 'geometry.diameter'?") != std::string::npos);
  CHECK(error("readout.resistance").find("give it in the scene, too") != std::string::npos);
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
  const std::string table = files.scene.beside("table.txt");
  write_file(table, "time_s,force_N\n0,1\n", false);
  CHECK(error_with(table).find("is not an SQLite database") != std::string::npos);
}
