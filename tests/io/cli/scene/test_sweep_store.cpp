// The store of a sweep: which points are answers, and of which inputs.
#include "io/basics/atomic_file.h"
#include "io/basics/parallel.h"
#include "io/flow/sweep/run_study.h"
#include "models/maths/may_stop.h"
#include "tests/io/cli/scene/study_files.h"
#include "tests/support/error_text.h"
#include "tests/support/run_command.h"
#include "tests/support/scratch_folder.h"

#include <nlohmann/json.hpp>
#include <sys/resource.h>
#include <sys/wait.h>
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
