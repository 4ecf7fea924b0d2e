// --force replaces what an earlier run wrote, never what the command reads.
#include "io/basics/atomic_file.h"
#include "tests/support/error_text.h"
#include "tests/support/run_command.h"
#include "tests/support/scratch_folder.h"

#include <catch2/catch.hpp>
#include <sys/stat.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace viscard {
namespace {

using test::contains;
using test::run_command;

TEST_CASE("no output replaces an input of the same command, even with --force", "[cli]") {
  const test::ScratchFolder folder;
  const std::string input = (folder / "input").string();
  const std::string linked = (folder / "linked").string();
  write_file(input, "time_s,force_N\n0,1\n", false);
  std::filesystem::create_symlink(input, linked);
  const std::vector<std::vector<std::string>> lines{
      {"export", input, "--out", input},
      {"export", input, "--out", linked},
      {"fit", input, "--out", (folder / "." / "input").string()},
      {"card", input, "--for", "abaqus", "--out", input},
      {"card", "--check", input, "--for", "abaqus", "--out", input},
      {"validate", input, "--csv", input},
      {"validate", input, "--creep-csv", input},
      {"report", input, "--out", input},
      {"simulate", input, "--out", input},
      {"scene", "check", input, "--svg", input},
      {"capture", "--emulate", "--test", input, "--out", input},
      {"capture", "--emulate", "--specimen", input, "--out", input},
      {"calibrate", "--data", input, "--out", input},
  };
  for (std::vector<std::string> words : lines) {
    words.emplace_back("--force");
    const auto outcome = run_command(words);
    CAPTURE(words, outcome.err);
    CHECK(outcome.status == kBadWords);
    CHECK(contains(outcome.err, "is also read by this command; choose another name"));
    CHECK(read_file(input) == "time_s,force_N\n0,1\n");
  }
}

TEST_CASE("no output replaces the side file of a database, or a link that leads to nothing",
          "[cli]") {
  const test::ScratchFolder folder;
  const std::string table = VISCARD_SOURCE_DIR "/data/demo/example_relaxation.csv";
  const auto answer = [&](const std::string& out, bool is_forced) {
    std::vector<std::string> words{"fit", table, "--out", out};
    if (is_forced) words.emplace_back("--force");
    const auto outcome = run_command(words);
    CHECK(outcome.status == kFailed);
    return outcome.err;
  };
  const std::string database = (folder / "run.viscap").string(),
                    link = (folder / "link.json").string();
  write_file(database, std::string("SQLite format 3\0", 16) + std::string(84, ' '), false);
  std::filesystem::create_symlink("none.json", link);
  for (const bool is_forced : {false, true}) {
    for (const char* ending : {"-wal", "-shm", "-journal"}) {
      CHECK(contains(answer(database + ending, is_forced),
                     "is the name of a side file of " + database));
    }
    CHECK(contains(answer(link, is_forced),
                   "leads to none.json, which does not exist; name the file itself"));
  }
  CHECK(std::filesystem::is_symlink(link));
  CHECK_FALSE(std::filesystem::exists(database + "-wal"));
  write_file(folder / "notes-wal", "beside no database", false);  // an ordinary name
}

TEST_CASE("two outputs of one command cannot share a file", "[cli]") {
  const test::ScratchFolder folder;
  const std::string table = (folder / "table.csv").string();
  const auto outcome =
      run_command({"validate", "material.json", "--csv", table, "--creep-csv", table});
  CHECK(outcome.status == kBadWords);
  CHECK(contains(outcome.err, "is also --"));
}

TEST_CASE("an output may have the name of a word that is not a file", "[cli]") {
  const test::ScratchFolder folder;
  const auto outcome = run_command(
      {"fit", (folder / "missing.csv").string(), "--kind", "relaxation", "--out", "relaxation"});
  CHECK_FALSE(contains(outcome.err, "is also"));
}

TEST_CASE("an output that cannot be written is refused before the work starts", "[cli]") {
  const test::ScratchFolder folder;
  const std::string file = (folder / "file").string();
  write_file(file, "x", false);
  const auto outcome = run_command({"fit", "missing.csv", "--out", file + "/material.json"});
  CHECK(outcome.status == kFailed);
  CHECK(contains(outcome.err, "is not a folder; choose another place"));
  CHECK_FALSE(contains(outcome.err, "missing.csv"));
}

TEST_CASE(
    "a folder in the place of a file, or a file in no folder, is refused before the work starts",
    "[cli]") {
  const test::ScratchFolder folder;
  const std::string none = (folder / "none/result.x").string(), here = folder.path().string();
  const std::vector<std::vector<std::string>> lines{{"fit", "missing.csv", "--out"},
                                                    {"fit", "missing.csv", "--svg"},
                                                    {"card", "m.json", "--for", "abaqus", "--out"},
                                                    {"export", "run.viscap", "--out"},
                                                    {"predict", "m.json", "--csv"},
                                                    {"predict", "m.json", "--svg"},
                                                    {"validate", "m.json", "--csv"},
                                                    {"scene", "check", "s.toml", "--svg"},
                                                    {"report", "m.json", "--out"},
                                                    {"sweep", "s.toml", "--csv"},
                                                    {"sweep", "s.toml", "--out"},
                                                    {"calibrate", "--data", "t.csv", "--out"},
                                                    {"capture", "--emulate", "--out"}};
  for (std::vector<std::string> words : lines) {
    words.push_back(here);
    CAPTURE(words);
    const auto as_folder = run_command(words);
    CHECK(as_folder.status == kFailed);
    CHECK(contains(as_folder.err, "it is a folder; name a file in it"));
    words.back() = none;
    CHECK(contains(run_command(words).err, "there is no folder"));
    words.back() = "/dev/null";
    CHECK(contains(run_command(words).err, "it is a device or pipe"));
    words.emplace_back("--force");
    CHECK(contains(run_command(words).err, "it is a device or pipe"));
  }
  write_file(folder / "old.json", "{}", false);
  const auto forgotten = run_command({"fit", "missing.csv", "--out", "--json"});
  CHECK(forgotten.status == kBadWords);
  CHECK(contains(forgotten.err, "--out needs a value; '--json' is an option"));
  const auto existing = run_command({"fit", "missing.csv", "--out", folder / "old.json"});
  CHECK(contains(existing.err, "exists already; pass --force"));
}

TEST_CASE("no output may be named - , and nothing is made before that is refused", "[cli]") {
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"capture", "--emulate", "--out"},
        {"capture", "--emulate", "--repeat", "2", "--out"},
        {"calibrate", "--data", "t.csv", "--out"},
        {"export", "run.viscap", "--out"},
        {"fit", "a.csv", "--out"},
        {"fit", "a.csv", "--csv"},
        {"predict", "m.json", "--svg"},
        {"card", "m.json", "--for", "abaqus", "--out"},
        {"card", "m.json", "--for", "abaqus", "--deck", "creep", "--out"},
        {"card", "c.inp", "--for", "abaqus", "--import"},
        {"validate", "m.json", "--creep-csv"},
        {"scene", "check", "s.toml", "--svg"},
        {"simulate", "s.toml", "--out"},
        {"sweep", "s.toml", "--out"},
        {"design", "s.toml", "--out"},
        {"cost", "s.toml", "--out"},
        {"report", "m.json", "--out", "page.html", "--pictures"},
        {"demo", "--out"},
        {"help", "--schemas"}}) {
    std::vector<std::string> line = words;
    line.emplace_back("-");
    const auto outcome = run_command(line);
    CAPTURE(line, outcome.err);
    CHECK(outcome.status == kBadWords);
    CHECK(contains(outcome.err, words.back() + " '-': is standard output"));
    CHECK(contains(outcome.err, "write ./- for one of that name"));
    CHECK_FALSE(std::filesystem::exists("-"));
  }
}

TEST_CASE("an input that only another input names is not replaced either", "[cli]") {
  const test::ScratchFolder folder;
  const std::string scene = (folder / "scene.toml").string(),
                    study = (folder / "study.toml").string(), card = (folder / "card.inp").string(),
                    material = VISCARD_SOURCE_DIR "/data/materials/pdms_1to10_seed.json";
  std::filesystem::copy_file(VISCARD_SOURCE_DIR "/data/scenes/pillar_creep.toml", scene);
  write_file(study,
             "scene = \"scene.toml\"\n[[parameter]]\nkey = \"geometry.diameter\"\nvalues = [\"40 "
             "um\"]\n",
             false);
  REQUIRE(run_command({"card", material, "--for", "abaqus", "--units", "mm-t-s", "--out", card})
              .status == 0);
  const std::vector<std::vector<std::string>> lines{
      {"sweep", study, "--out", (folder / "s.sqlite").string(), "--csv", scene, "--force"},
      {"card", card, "--for", "abaqus", "--units", "mm-t-s", "--import", card, "--force"},
  };
  for (const std::vector<std::string>& words : lines) {
    const std::string before = read_file(words.front() == "sweep" ? scene : card);
    const auto outcome = run_command(words);
    INFO(outcome.out << outcome.err);
    CHECK(outcome.status != 0);
    CHECK(contains(outcome.err, "is read by this command"));
    CHECK(read_file(words.front() == "sweep" ? scene : card) == before);
  }
}

TEST_CASE("a file beyond any use is refused before it is read, and its sum takes no memory",
          "[cli][io]") {
  const test::ScratchFolder folder;
  const std::filesystem::path file = folder / "huge.csv";
  write_file(file, "time_s,force_N\n", false);
  CHECK(sha256_of_file(file) == sha256_of_text(read_file(file)));
  std::filesystem::resize_file(file, std::uintmax_t{3} << 30);  // a hole: takes no disk
  for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
           {"fit", file},
           {"fit", VISCARD_SOURCE_DIR "/data/demo/example_relaxation.csv", "--constraints", file},
           {"card", "--check", file, "--for", "abaqus"},
           {"card", "--verify", file},
           {"simulate", file},
           {"report", file, "--out", (folder / "page.html").string()}}) {
    CAPTURE(words);
    const auto outcome = run_command(words);
    CHECK(outcome.status != 0);
    CHECK(contains(outcome.err, "MiB, the limit of such a file"));
  }
}

TEST_CASE("a folder that cannot be made is one clear line", "[cli]") {
  const auto outcome = run_command({"demo", "--out", "/proc/viscard"});
  CHECK(outcome.status == kFailed);
  CHECK(contains(outcome.err, "'/proc/viscard': "));
  CHECK_FALSE(contains(outcome.err, "filesystem error"));
}

TEST_CASE("a device or pipe is never replaced by a file, even with --force", "[cli][io]") {
  const test::ScratchFolder folder;
  const std::filesystem::path pipe = folder / "pipe";
  REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
  CHECK_THROWS_WITH(write_file(pipe, "text", true), Catch::Contains("is a device or pipe"));
  CHECK(std::filesystem::is_fifo(pipe));
}

TEST_CASE("an output with the ending of another format is refused", "[cli]") {
  const test::ScratchFolder folder;
  const std::string material = VISCARD_SOURCE_DIR "/data/materials/pdms_1to10_seed.json";
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases{
      {{"predict", material, "--svg", folder / "a.png"}, ".png is another format"},
      {{"predict", material, "--svg", folder / "a.HTML"}, "end its name with .svg"},
      {{"predict", material, "--csv", folder / "a.xlsx"}, "end its name with .csv"},
      {{"report", material, "--out", folder / "r.pdf"}, "what is written is html"},
      {{"report", material, "--out", folder / "r.svg"}, "end its name with .html"},
      {{"export", "r.viscap", "--out", folder / "r.truth.json", "--force"},
       "end its name with .csv"},
      {{"fit", "a.csv", "--out", folder / "m.csv"}, "end its name with .json"},
      {{"sweep", "s.toml", "--out", folder / "s.csv"}, "end its name with .sqlite"},
      {{"calibrate", "--data", "w.csv", "--out", folder / "c.json"}, "end its name with .toml"},
      {{"capture", "--emulate", "--out", folder / "r.csv"}, "end its name with .viscap"},
      {{"simulate", "s.toml", "--out", folder / "x.png"}, "no command writes .png"}};
  for (const auto& [words, text] : cases) {
    CAPTURE(words);
    const auto outcome = run_command(words);
    CHECK(outcome.status == kBadWords);
    CHECK(contains(outcome.err, text));
  }
  CHECK(std::filesystem::is_empty(folder / "."));
  CHECK(run_command({"predict", material, "--csv", folder / "a.dat"}).status == kDone);
}

TEST_CASE("the option --force without an output is refused by every command that replaces files",
          "[cli]") {
  const std::vector<std::vector<std::string>> all{{"fit", "a.csv"},
                                                  {"card", "m.json", "--for", "abaqus"},
                                                  {"predict", "m.json"},
                                                  {"validate", "m.json"},
                                                  {"simulate", "s.toml"},
                                                  {"scene", "check", "s.toml"},
                                                  {"design"},
                                                  {"cost", "s.toml"},
                                                  {"sweep", "s.toml"},
                                                  {"export", "r.viscap"}};
  for (std::vector<std::string> words : all) {
    words.emplace_back("--force");
    CAPTURE(words);
    const auto outcome = run_command(words);
    CHECK(outcome.status == kBadWords);
    CHECK(contains(outcome.err, "--force has no effect without --"));
  }
}

}  // namespace
}  // namespace viscard
