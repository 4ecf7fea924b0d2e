// Files that are missing, empty or of another kind: what they are, where they are named, what to do next.
#include "io/basics/atomic_file.h"
#include "io/basics/file_kind.h"
#include "tests/support/error_text.h"
#include "tests/support/run_command.h"
#include "tests/support/scratch_folder.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <filesystem>

namespace viscard {
namespace {

using test::contains;
using test::run_command;
using test::ScratchFolder;

std::string shipped(const std::string& name) {
  return VISCARD_SOURCE_DIR "/data/" + name;
}

TEST_CASE("a scene that names a missing file reports line, key, whole path and what to do next",
          "[cli]") {
  const ScratchFolder folder;
  std::filesystem::create_directory(folder / "copied");
  const std::string scene = folder / "copied/scene.toml";
  write_file(scene, read_file(shipped("scenes/pillar_sensor.toml")), false);
  const auto outcome = run_command({"simulate", scene, "--json"});
  CHECK(outcome.status == kFailed);
  CHECK(contains(outcome.err, scene + ":"));
  CHECK(contains(outcome.err, "materials.pvdf.file: names '../materials/pvdf_film_manual.json'"));
  const std::filesystem::path whole =
      std::filesystem::canonical(folder.path()) / "materials/pvdf_film_manual.json";
  CHECK(contains(outcome.err, "no file '" + whole.string() + "'"));
  const auto error = nlohmann::json::parse(outcome.out).at("error");
  CHECK(error["code"] == "input");
  CHECK_FALSE(error["hint"].get<std::string>().empty());

  write_file(folder / "pillar.toml",
             "[geometry]\ndiameter = \"40 um\"\nlength = \"120 um\"\n[materials]\n"
             "pillar = { file = \"pdm.json\" }\n",
             false);
  CHECK(contains(run_command({"plan", folder / "pillar.toml"}).err,
                 "pillar.toml:5: materials.pillar.file: names 'pdm.json', but there is no file"));
  write_file(folder / "pdms.json", "{}", false);
  CHECK(contains(run_command({"plan", folder / "pillar.toml"}).err, "pdms.json'?"));
}

TEST_CASE("studies, design tasks and rigs report the missing files that they name", "[cli]") {
  const ScratchFolder folder;
  write_file(folder / "study.toml",
             "scene = \"no.toml\"\n[[parameter]]\nkey = \"geometry.length\"\nvalues = [\"1 um\"]\n",
             false);
  CHECK(contains(run_command({"sweep", folder / "study.toml"}).err,
                 "study.toml:1: scene: names 'no.toml', but there is no file"));
  write_file(folder / "task.toml",
             "scene = \"no.toml\"\n[[range]]\nkey = \"geometry.length\"\n"
             "from = \"1 um\"\nto = \"2 um\"\n",
             false);
  CHECK(contains(run_command({"design", folder / "task.toml"}).err,
                 "task.toml:1: scene: names 'no.toml', but there is no file"));
  std::string rig = read_file(shipped("demo/01_rig.toml"));
  const std::size_t at = rig.find("volts_per_newton =");
  rig.insert(at, "file = \"cell.toml\"\n");
  write_file(folder / "rig.toml", rig, false);
  CHECK(contains(run_command({"rig", "check", "--rig", folder / "rig.toml"}).err,
                 "calibration.file: names 'cell.toml', but there is no file"));
}

TEST_CASE("a missing file on the command line is followed by what to do next, in every command",
          "[cli]") {
  const ScratchFolder folder;
  write_file(folder / "sample_1.txt", "1", false);
  const std::string near = folder / "sample_2.txt", lost = folder / "none/x.toml";
  const std::vector<std::vector<std::string>> lines{{"fit"},
                                                    {"simulate"},
                                                    {"plan"},
                                                    {"cost"},
                                                    {"scene", "check"},
                                                    {"sweep"},
                                                    {"design"},
                                                    {"predict"},
                                                    {"validate"},
                                                    {"export"},
                                                    {"rig", "check", "--rig"},
                                                    {"card", "--for", "abaqus"},
                                                    {"report", "--out", folder / "page.html"}};
  for (std::vector<std::string> words : lines) {
    words.push_back(near);
    CAPTURE(words);
    const auto outcome = run_command(words);
    CHECK(outcome.status == kFailed);
    CHECK(contains(outcome.err, "did you mean '" + (folder / "sample_1.txt").string() + "'?"));
    words.back() = lost;
    CHECK(contains(run_command(words).err, "there is no folder"));
  }
}

TEST_CASE("a file of another kind is named, with the command that takes it", "[cli]") {
  const ScratchFolder folder;
  const std::string table = folder / "t.csv", empty = folder / "empty", bytes = folder / "bytes";
  write_file(table, "time_s,force_N\n0,1\n1,2\n", false);
  write_file(empty, "", false);
  write_file(bytes, std::string("\x01\x02\x00\x03", 4), false);
  const std::string material = shipped("materials/pdms_1to10_seed.json");
  const std::string scene = shipped("scenes/pillar_modal.toml");
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases{
      {{"simulate", material}, ":1: is a material, not a scene; viscard card"},
      {{"card", scene, "--for", "abaqus"}, ":1: is a scene, not a material; viscard scene check"},
      {{"fit", scene}, "is a scene, not a table; viscard scene check"},
      {{"fit", material}, "is a material, not a table; viscard card"},
      {{"export", scene}, "is a scene, not a capture"},
      {{"predict", table}, ":1: is a table of numbers, not a material; viscard fit"},
      {{"validate", empty}, ":1: is empty, not a material; expected JSON"},
      {{"validate", bytes}, ":1: is a binary file, not a material; expected JSON"},
      {{"plan", empty}, ":1: is empty, not a scene; expected TOML"},
      {{"plan", bytes}, ":1: is a binary file, not a scene; expected TOML"},
      {{"plan", table}, ":1: is a table of numbers, not a scene"},
      {{"sweep", scene}, ":1: is a scene, not a study"},
      {{"design", table}, ":1: is a table of numbers, not a scene; viscard fit"},
      {{"card", "--check", empty}, ":1: is empty, not a material card; expected a text"},
      {{"card", "--check", material}, ":1: is a material, not a material card; viscard card"},
      {{"simulate", shipped("studies/pillar.toml")}, "is a study, not a scene; viscard sweep"},
      {{"rig", "check", "--rig", shipped("demo/02_test.toml")}, "is a test of the rig, not a rig"},
  };
  for (const auto& [words, text] : cases) {
    CAPTURE(words);
    const auto outcome = run_command(words);
    CHECK(outcome.status == kFailed);
    CHECK(contains(outcome.err, text));
  }
}

TEST_CASE("a table with the name of a capture is to be renamed", "[cli]") {
  const ScratchFolder folder;
  write_file(folder / "t.viscap", "time_s,force_N\n0,1\n1,2\n", false);
  const auto outcome = run_command({"fit", folder / "t.viscap"});
  CHECK(outcome.status == kFailed);
  CHECK(contains(outcome.err,
                 "is a table of numbers, not a capture; give it a name that ends in "
                 ".csv instead of .viscap"));
}

TEST_CASE("every file that is shipped is of the kind of its folder", "[io]") {
  const std::vector<std::pair<std::string, FileKind>> folders{
      {"scenes", FileKind::kScene},       {"seed", FileKind::kScene},
      {"protocols", FileKind::kRigTest},  {"requirements", FileKind::kRequirements},
      {"designs", FileKind::kDesignTask}, {"reference", FileKind::kTable}};
  for (const auto& [name, kind] : folders) {
    for (const auto& entry : std::filesystem::directory_iterator(shipped(name))) {
      CAPTURE(entry.path());
      CHECK(kind_of_file(read_file(entry.path())) == kind);
    }
  }
}

TEST_CASE("a mistake in JSON is reported with its line and without words of the reader", "[io]") {
  const ScratchFolder folder;
  write_file(folder / "m.json", "{\"E0_Pa\": 1,\n \"nu\" 3}", false);
  const std::string text = run_command({"validate", folder / "m.json"}).err;
  CHECK(contains(text, "m.json:2: is not JSON: at column 7"));
  CHECK_FALSE(contains(text, "parse"));
}

}  // namespace
}  // namespace viscard
