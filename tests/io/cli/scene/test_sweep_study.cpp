#include "io/basics/atomic_file.h"
#include "io/basics/parallel.h"
#include "io/flow/sweep/run_study.h"
#include "io/scenes/scene_file.h"
#include "models/maths/may_stop.h"
#include "tests/io/scenes/scene_text.h"
#include "tests/support/error_text.h"
#include "tests/support/run_command.h"
#include "tests/support/scratch_folder.h"

#include <nlohmann/json.hpp>
#include <sys/resource.h>
#include <sys/wait.h>
#include <toml++/toml.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <future>
#include <map>
#include <set>

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

namespace {

const char* const kFilmScene = R"(tolerance = 1e-2
[geometry]
diameter = "40 um"
length = "120 um"
[materials]
pillar = { file = "rubber.json" }
[analysis]
kind = "static"
load = { pressure = "1 kPa", on = "top" }
[want]
quantities = ["top_displacement"]
)";

const char* const kFilmStudy = R"(scene = "scene.toml"
[[parameter]]
key = "geometry.diameter"
values = ["36 um", "40 um"]
[[parameter]]
key = "materials.pillar.file"
values = ["rubber.json", "other.json"]
)";

std::string rubber(double E0_Pa) {
  return "{\"schema\": \"viscard-material/1\", \"E0_Pa\": " + std::to_string(E0_Pa) +
         ", \"nu\": 0.4, \"terms\": []}\n";
}

// A study whose scene names materials.
struct FilmStudy {
  SceneText scene{kFilmScene};
  std::string study = scene.beside("study.toml"), store = scene.beside("a.sqlite"),
              first = scene.beside("rubber.json"), second = scene.beside("other.json");
  FilmStudy() {
    write_file(study, kFilmStudy, false);
    write_file(first, rubber(1.8e6), false);
    write_file(second, rubber(2.5e6), false);
  }
  CommandOutcome sweep(std::vector<std::string> words) const {
    words.insert(words.begin(), {"sweep", study});
    return run_command(words);
  }
};

void change_store(const std::string& file, const char* sql) {
  Database(file, Database::Access::kReadWrite).execute(sql);
}

bool says(const std::string& text, const std::string& words) {
  return text.find(words) != std::string::npos;
}

}  // namespace

TEST_CASE("a sweep does not go on with points that were answered with another material",
          "[cli][scene][sweep]") {
  const FilmStudy files;
  REQUIRE(files.sweep({"--out", files.store}).status == 0);
  CHECK(files.sweep({"--out", files.store}).status == 0);
  write_file(GENERATE(0, 1) == 0 ? files.first : files.second, rubber(0.9e6), true);
  const CommandOutcome outcome = files.sweep({"--out", files.store});
  CAPTURE(outcome.err);
  CHECK(outcome.status == 1);
  CHECK(says(outcome.err, "answered with other files"));
  CHECK(says(outcome.err, ".json has changed since"));
}

TEST_CASE("parts of a sweep that were answered with different materials are not merged",
          "[cli][scene][sweep]") {
  const FilmStudy files;
  const std::string one = files.scene.beside("1.sqlite"), two = files.scene.beside("2.sqlite");
  REQUIRE(files.sweep({"--out", one, "--shard", "1/2"}).status == 0);
  write_file(files.first, rubber(0.9e6), true);
  REQUIRE(files.sweep({"--out", two, "--shard", "2/2"}).status == 0);
  const CommandOutcome outcome =
      files.sweep({"--out", files.scene.beside("all.sqlite"), "--merge", one, "--merge", two});
  CHECK(outcome.status == 1);
  CHECK(says(outcome.err, "1.sqlite: its points were answered with other files"));
}

TEST_CASE("a merge of parts that cannot be read leaves no store", "[cli][scene][sweep]") {
  const FilmStudy files;
  const std::string none = files.scene.beside("none.sqlite");
  write_file(files.scene.beside("other.sqlite"), "no database", false);
  for (const std::string& part : {none, files.scene.beside("other.sqlite")}) {
    CHECK(files.sweep({"--out", files.store, "--merge", part}).status == 1);
    CHECK_FALSE(std::filesystem::exists(files.store));
  }
}

TEST_CASE("the table of a sweep has the sums of its inputs beside it", "[cli][scene][sweep]") {
  const FilmStudy files;
  const std::string table = files.scene.beside("a.csv");
  REQUIRE(files.sweep({"--out", files.store, "--csv", table}).status == 0);
  const auto json = nlohmann::json::parse(read_file(table + ".inputs.json"));
  CHECK(json["schema"] == "viscard-inputs/1");
  CHECK(json["is_recorded"] == true);
  CHECK(json["table_sha256"] == sha256_of_file(table));
  std::map<std::string, std::string> sums;
  for (const auto& file : json["files"]) sums[file["path"]] = file["sha256"];
  CHECK(sums.size() == 4);
  CHECK(sums["rubber.json"] == sha256_of_file(files.first));
  CHECK(sums["other.json"] == sha256_of_file(files.second));
  CHECK(sums.count("study.toml") == 1);
  CHECK_FALSE(json.contains("plausible"));
  const std::vector<std::string> off = {"--out",   files.store,   "--csv", table,
                                        "--force", "--plausible", "off"};
  REQUIRE(files.sweep(off).status == 0);
  CHECK(nlohmann::json::parse(read_file(table + ".inputs.json"))["plausible"] == "off");
}

TEST_CASE("a store without recorded inputs goes on only if that is accepted",
          "[cli][scene][sweep]") {
  const FilmStudy files;
  REQUIRE(files.sweep({"--out", files.store}).status == 0);
  change_store(files.store, "DROP TABLE inputs; DELETE FROM points WHERE point > 1");
  const CommandOutcome refused = files.sweep({"--out", files.store});
  CHECK(refused.status == 1);
  CHECK(says(refused.err, "inputs not recorded"));
  const CommandOutcome outcome = files.sweep({"--out", files.store, "--accept-unrecorded"});
  CHECK(outcome.status == 0);
  CHECK(says(outcome.err, "inputs not recorded"));
  CHECK(says(outcome.out, "4 of 4 points are done"));
}

TEST_CASE("refused points are counted apart from failed ones, which are tried again if asked",
          "[cli][scene][sweep]") {
  const FilmStudy files;
  write_file(files.study, R"(scene = "scene.toml"
[[parameter]]
key = "materials.pillar.nu"
values = ["0.3", "-1"]
)",
             true);
  write_file(files.scene.path(),
             replaced(kFilmScene, "{ file = \"rubber.json\" }", "{ E = \"2 MPa\", nu = 0.3 }"),
             true);
  const CommandOutcome outcome = files.sweep({"--out", files.store, "--json"});
  CAPTURE(outcome.err);
  CHECK(outcome.status == 0);
  CHECK(says(outcome.err, "1 of the 2 points answered now is refused"));
  const auto json = nlohmann::json::parse(outcome.out);
  CHECK(json["refused"] == 1);
  CHECK(json["failed"] == 0);
  CHECK(json["answered"] == 2);
  // As if the program had failed on the first point, which --retry-failed answers again.
  const Study study = read_study(files.study);
  {
    StudyStore store(files.store, study);
    change_store(files.store, "DELETE FROM points WHERE point = 0");
    StudyPoint failed{.point = 0, .values = values_at(study, 0)};
    failed.failure = "an error of the program";
    failed.kind = PointKind::kPassing;
    store.add(failed);
    CHECK(store.done().size() == 1);  // what may pass is not kept
    failed.kind = PointKind::kError;
    store.add(failed);
  }
  CHECK(says(files.sweep({"--out", files.store}).err, "--retry-failed"));
  const CommandOutcome again = files.sweep({"--out", files.store, "--retry-failed"});
  CHECK(again.status == 0);
  CHECK(says(again.out, "1 answered now"));
  CHECK(StudyStore(files.store, study).count(PointKind::kAnswered) == 1);
}

TEST_CASE("a damaged row of a store is not an answer", "[cli][scene][sweep]") {
  const FilmStudy files;
  REQUIRE(files.sweep({"--out", files.store}).status == 0);
  const Study study = read_study(files.study);
  const std::string whole = [&] {
    StudyStore store(files.store, study);
    return csv_from_study(store, study);
  }();
  change_store(
      files.store,
      GENERATE("UPDATE points SET results = replace(results, '1', '2') WHERE point = 1",
               "UPDATE points SET failure = 'x' WHERE point = 1",
               "UPDATE points SET kind = 'refused' WHERE point = 1",
               "UPDATE points SET crc32 = NULL WHERE point = 1",
               "UPDATE points SET results = replace(results, '1', '2'), kind = NULL, crc32 "
               "= NULL WHERE point = 1",
               "UPDATE points SET point = 7 WHERE point = 1"));
  const CommandOutcome outcome = files.sweep({"--out", files.store});
  CHECK(outcome.status == 0);
  CHECK(says(outcome.err, "1 row damaged"));
  StudyStore store(files.store, study);
  CHECK(csv_from_study(store, study) == whole);
}

TEST_CASE("a row of another study is not an answer of this one", "[cli][scene][sweep]") {
  const FilmStudy files;
  const std::string other = files.scene.beside("other.sqlite"), part = files.scene.beside("part");
  REQUIRE(files.sweep({"--out", other}).status == 0);
  write_file(files.study,
             std::string(kFilmStudy) + "[[parameter]]\nkey = \"tolerance\"\nvalues = [\"0.02\"]\n",
             true);
  REQUIRE(files.sweep({"--out", files.store}).status == 0);
  std::filesystem::copy_file(files.store, part);
  const Study study = read_study(files.study);
  const std::string whole = [&] {
    StudyStore store(files.store, study);
    return csv_from_study(store, study);
  }();
  // As a log that another store has left beside this one does, page by page.
  change_store(part, ("ATTACH '" + other +
                      "' AS b; DELETE FROM points WHERE point = 1; INSERT INTO points SELECT * "
                      "FROM b.points WHERE point = 1")
                         .c_str());
  const std::string all = files.scene.beside("all.sqlite");
  const CommandOutcome merged = files.sweep({"--out", all, "--merge", part});
  CHECK(says(merged.err, "1 row damaged or of another study"));
  CHECK(StudyStore(all, study).done() == std::set<std::int64_t>{0, 2, 3});
  const CommandOutcome outcome = files.sweep({"--out", part});
  CHECK(outcome.status == 0);
  CHECK(says(outcome.err, "1 row damaged or of another study"));
  StudyStore store(part, study);
  CHECK(csv_from_study(store, study) == whole);
}

TEST_CASE("inputs of one name that have changed places are noticed", "[cli][scene][sweep]") {
  const SceneText scene(kFilmScene);
  const std::filesystem::path folder = std::filesystem::path(scene.path()).parent_path();
  for (const char* name : {"a", "b", "s"}) std::filesystem::create_directory(folder / name);
  const std::string first = folder / "a" / "rubber.json", second = folder / "b" / "rubber.json",
                    study = folder / "s" / "study.toml", store = scene.beside("a.sqlite");
  write_file(first, rubber(1.8e6), false);
  write_file(second, rubber(2.5e6), false);
  write_file(study,
             "scene = \"../scene.toml\"\n[[parameter]]\nkey = \"materials.pillar.file\"\n"
             "values = [\"a/rubber.json\", \"b/rubber.json\"]\n",
             false);
  REQUIRE(run_command({"sweep", study, "--out", store}).status == 0);
  CHECK(run_command({"sweep", study, "--out", store}).status == 0);
  write_file(first, rubber(2.5e6), true);
  write_file(second, rubber(1.8e6), true);
  const CommandOutcome outcome = run_command({"sweep", study, "--out", store});
  CHECK(outcome.status == 1);
  CHECK(says(outcome.err, "../a/rubber.json has changed since"));
}

TEST_CASE("a look at a database leaves no file beside it", "[cli][scene][sweep]") {
  const FilmStudy files;
  const std::string other = files.scene.beside("other.sqlite");
  write_file(other, "", false);
  change_store(other, "PRAGMA journal_mode = WAL; CREATE TABLE mine(a);");
  REQUIRE(files.sweep({"--out", files.store}).status == 0);
  CHECK(files.sweep({"--out", other}).status == 1);
  CHECK(files.sweep({"--out", files.scene.beside("all.sqlite"), "--merge", files.store}).status ==
        0);
  for (const std::string& file : {other, files.store}) {
    CHECK_FALSE(std::filesystem::exists(file + "-wal"));
    CHECK_FALSE(std::filesystem::exists(file + "-shm"));
  }
}

TEST_CASE("the inputs of a study have one order, however it is named", "[cli][scene][sweep]") {
  const test::ScratchFolder folder;
  std::filesystem::create_directory(folder / "z");
  std::filesystem::create_directory(folder / "a");
  std::filesystem::copy_file(VISCARD_SOURCE_DIR "/data/scenes/pillar_creep.toml",
                             folder / "a" / "s.toml");
  const std::filesystem::path study = folder / "z" / "study.toml";
  write_file(study,
             "scene = \"" + (folder / "a" / "s.toml").string() +
                 "\"\n[[parameter]]\nkey = \"geometry.diameter\"\nvalues = [\"40 um\"]\n",
             false);
  const std::filesystem::path near = std::filesystem::relative(study);
  REQUIRE(near.is_relative());
  CHECK(fingerprint_with_inputs(read_study(study)) == fingerprint_with_inputs(read_study(near)));
}

TEST_CASE("a database that is not the store of a study is not changed", "[cli][scene][sweep]") {
  const FilmStudy files;
  const std::string other = files.scene.beside("other.sqlite");
  write_file(other, "", false);
  change_store(other, GENERATE("CREATE TABLE mine(a)",
                               "PRAGMA application_id = 0x56434150; CREATE TABLE run(a)",
                               "CREATE TABLE study(a)", "PRAGMA user_version = 7",
                               "CREATE TABLE points(a); CREATE TABLE study(a)"));
  const std::string before = read_file(other);
  const CommandOutcome outcome = files.sweep({"--out", other});
  CHECK(outcome.status == 1);
  CHECK(says(outcome.err, "not the points of a study; it was not changed"));
  CHECK(read_file(other) == before);
  CHECK(files.sweep({"--out", files.store, "--merge", other}).status == 1);
  CHECK(read_file(other) == before);
  CHECK_FALSE(std::filesystem::exists(other + "-wal"));
}

TEST_CASE("a store of another study keeps its bytes, and a link that leads nowhere makes no file",
          "[cli][scene][sweep]") {
  const FilmStudy files;
  REQUIRE(files.sweep({"--out", files.store}).status == 0);
  Database(files.store, Database::Access::kReadWrite).execute("PRAGMA journal_mode = DELETE;");
  const std::string before = read_file(files.store);
  const StudyFiles other;
  const CommandOutcome refused = run_command({"sweep", other.study, "--out", files.store});
  CHECK(refused.status == 1);
  CHECK(says(refused.err, "another study"));
  CHECK(read_file(files.store) == before);
  const std::string link = files.scene.beside("link.sqlite");
  std::filesystem::create_symlink(files.scene.beside("nothing.sqlite"), link);
  CHECK(says(files.sweep({"--out", link}).err, "which does not exist"));
  CHECK_FALSE(std::filesystem::exists(files.scene.beside("nothing.sqlite")));
}

TEST_CASE("a sweep deletes no log of a store that was moved away", "[cli][scene][sweep]") {
  const FilmStudy files;
  const std::string log = files.store + "-wal";
  write_file(log, "the newest points", false);
  for (const bool is_empty : {false, true}) {
    if (is_empty) write_file(files.store, "", false);
    const CommandOutcome refused = files.sweep({"--out", files.store});
    CHECK(refused.status == 1);
    CHECK(says(refused.err, log + " belongs to an earlier sweep whose main file is gone"));
    CHECK(read_file(log) == "the newest points");
    CHECK(std::filesystem::exists(files.store) == is_empty);
  }
}

#ifndef __SANITIZE_ADDRESS__  // whose shadow needs terabytes of addresses
TEST_CASE("a lack of memory is no answer of a point", "[cli][scene][sweep]") {
  const ScratchFolder folder;
  const std::string study = VISCARD_SOURCE_DIR "/data/studies/pillar.toml",
                    store = (folder / "store.sqlite").string();
  const pid_t child = fork();
  if (child == 0) {
    // Some points need about 0.4 GB, by a count of unknowns before any mesh is made.
    const rlimit little{350'000'000, 350'000'000};
    setrlimit(RLIMIT_AS, &little);
    execl(VISCARD_PROGRAM, VISCARD_PROGRAM, "sweep", study.c_str(), "--out", store.c_str(),
          nullptr);
    _exit(127);
  }
  int status = 0;
  REQUIRE(waitpid(child, &status, 0) == child);
  CHECK((WIFEXITED(status) && WEXITSTATUS(status) == 1));
  CHECK(StudyStore(store, read_study(study)).count(PointKind::kRefused) == 0);
  const CommandOutcome outcome = run_command({"sweep", study, "--out", store, "--json"});
  CAPTURE(outcome.err);
  const auto json = nlohmann::json::parse(outcome.out);
  CHECK(json.at("answered") > 0);  // those that lacked memory
  CHECK(json.at("done") == 9);
  CHECK(StudyStore(store, read_study(study)).count(PointKind::kAnswered) == 9);
}
#endif

TEST_CASE("a second sweep into the same file is refused until the first has ended",
          "[cli][scene][sweep]") {
  const FilmStudy files;
  const StudyLock first(files.store, nullptr);
  const CommandOutcome outcome = files.sweep({"--out", files.store});
  CHECK(outcome.status == 1);
  CHECK(says(outcome.err, "another sweep is answering its points; wait for it to end"));
}

TEST_CASE("a store that is deleted or moved while points are answered is noticed",
          "[cli][scene][sweep]") {
  const FilmStudy files;
  const Study study = read_study(files.study);
  std::promise<std::string> said;
  StudyStore store(
      files.store, study,
      {.is_answering = true, .on_gone = [&](const std::string& why) { said.set_value(why); }});
  std::filesystem::rename(files.store, files.store + ".away");
  std::future<std::string> why = said.get_future();
  REQUIRE(why.wait_for(std::chrono::seconds(20)) == std::future_status::ready);
  CHECK(says(why.get(), "was moved to "));
  CHECK_THROWS_WITH(store.add(StudyPoint{}), Catch::Contains("while its points were answered"));
}

TEST_CASE("a word that a study misspells is refused before the first point",
          "[cli][scene][sweep]") {
  const FilmStudy files;
  const std::string study = read_file(files.study);
  write_file(
      files.study,
      study + "\n[[parameter]]\nkey = \"analysis.kind\"\nvalues = [\"static\", \"statik\"]\n",
      true);
  const CommandOutcome outcome = files.sweep({"--out", files.store});
  INFO(outcome.err);
  CHECK(outcome.status == 1);
  CHECK(says(outcome.err, "cannot be \"statik\""));
  CHECK_FALSE(std::filesystem::exists(files.store));
}

TEST_CASE("a file is an input of a study even if its name looks like a number with a unit",
          "[cli][scene][sweep]") {
  const FilmStudy files;
  const bool is_rows = GENERATE(false, true);
  for (const char* const name : {"10pdms", "20pdms"})
    write_file(files.scene.beside(name), rubber(1e6), false);
  write_file(files.study,
             std::string("scene = \"scene.toml\"\n") + (is_rows ? "rows = true\n" : "") +
                 "[[parameter]]\nkey = \"materials.pillar.file\"\n"
                 "values = [\"10pdms\", \"20pdms\"]\n",
             true);
  std::set<std::string> names;
  for (const InputFile& file : read_study(files.study).inputs) names.insert(file.path);
  CHECK(names == std::set<std::string>{"10pdms", "20pdms", "scene.toml", "study.toml"});
}

TEST_CASE("a point that reads a file which the study does not know is not kept",
          "[cli][scene][sweep]") {
  const FilmStudy files;
  Study study = read_study(files.study);
  CHECK(answer_point(study, 1).kind == PointKind::kAnswered);
  std::erase_if(study.inputs, [](const InputFile& file) { return file.path == "other.json"; });
  const StudyPoint point = answer_point(study, 1);
  CHECK(point.kind == PointKind::kPassing);
  CHECK(says(point.failure, "other.json is read at this point and was not when the sweep began"));
}

TEST_CASE("a link that leads to another file while a sweep works is noticed",
          "[cli][scene][sweep]") {
  const FilmStudy files;
  const std::string link = files.scene.beside("link.json");
  std::filesystem::create_symlink(files.first, link);
  write_file(files.study, replaced(kFilmStudy, "\"rubber.json\", \"other.json\"", "\"link.json\""),
             true);
  const Study study = read_study(files.study);
  REQUIRE(answer_point(study, 0).kind == PointKind::kAnswered);
  std::filesystem::remove(link);
  std::filesystem::create_symlink(files.second, link);
  const StudyPoint point = answer_point(study, 0);
  CHECK(point.kind == PointKind::kPassing);
  CHECK(point.results.empty());
}

TEST_CASE("a request to stop is no answer of a point", "[cli][scene][sweep]") {
  const FilmStudy files;
  const Study study = read_study(files.study);
  const StopCheck stop([] { throw Interrupted(); });
  CHECK_THROWS_AS(answer_point(study, 0), Interrupted);
}

TEST_CASE("a store with two names is refused before points could be lost", "[cli][scene][sweep]") {
  const FilmStudy files;
  REQUIRE(files.sweep({"--out", files.store, "--shard", "1/2"}).status == 0);
  const std::string name = files.scene.beside("name.sqlite");
  std::filesystem::create_hard_link(files.store, name);
  const CommandOutcome outcome = files.sweep({"--out", name});
  CHECK(outcome.status == 1);
  CHECK(says(outcome.err, "name.sqlite: the file has 2 names (hard links)"));
  std::filesystem::remove(name);
  CHECK(files.sweep({"--out", files.store}).status == 0);
}

TEST_CASE("the table of a sweep has the results of all its points", "[cli][scene][sweep]") {
  const FilmStudy files;
  const Study study = read_study(files.study);
  StudyStore store(files.store, study);
  const auto add = [&](std::int64_t number, std::vector<NamedValue> results) {
    store.add(StudyPoint{
        .point = number, .values = values_at(study, number), .results = std::move(results)});
  };
  add(0, {{"charge", 1.0, "C", 0.5}, {"displacement", 2.0, "m", 0.5}});
  add(1, {{"voltage", 3.0, "V", 0.5}, {"displacement", 4.0, "m", 0.5}});
  CHECK(csv_from_study(store, study) ==
        "point,geometry.diameter,materials.pillar.file,"
        "\"charge [C]\",\"error charge [C]\",\"displacement [m]\",\"error displacement [m]\","
        "\"voltage [V]\",\"error voltage [V]\",failure\n"
        "0,\"36 um\",\"rubber.json\",1,0.5,2,0.5,,,\n"
        "1,\"36 um\",\"other.json\",,,4,0.5,3,0.5,\n");
}
