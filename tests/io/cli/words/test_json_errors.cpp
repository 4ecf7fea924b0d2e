// What the commands print with --json when they fail.
#include "io/basics/atomic_file.h"
#include "io/flow/command_error.h"
#include "tests/support/run_command.h"
#include "tests/support/scratch_folder.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

namespace viscard {
namespace {

using Json = nlohmann::json;
using test::run_command;
using test::ScratchFolder;

std::string demo(const std::string& name) {
  return VISCARD_SOURCE_DIR "/data/demo/" + name;
}

// The error that a failing command prints as its only object on stdout.
Json error_of(const std::vector<std::string>& words, int status = kFailed) {
  const test::CommandOutcome outcome = run_command(words);
  INFO(outcome.out << outcome.err);
  CHECK(outcome.status == status);
  CHECK(outcome.err.rfind("viscard: ", 0) == 0);  // people still read the message
  Json error = Json::parse(outcome.out).at("error");
  for (const char* key : {"code", "message", "where", "hint"}) CHECK(error.at(key).is_string());
  CHECK(error.size() == 4);
  CHECK_FALSE(error.at("message").get<std::string>().empty());
  return error;
}

}  // namespace

TEST_CASE("a wrong command line has the code usage and names the option", "[cli]") {
  for (const Command& command : commands()) {
    const Json error = error_of({command.name, "--oust", "x", "--json"}, kBadWords);
    CHECK(error["code"] == "usage");
    CHECK(error["where"] == "--oust");
  }
}

TEST_CASE("a mistake in a file has the code input, with the line", "[cli]") {
  const ScratchFolder folder;
  write_file(folder / "rig.toml", "[stage]\nport = \"/dev/x\"\nspeedd = 3\n", false);
  const std::string file = folder / "rig.toml";
  const Json error = error_of({"rig", "check", "--rig", file, "--json"});
  CHECK(error["code"] == "input");
  CHECK(error["where"] == file + ":3");
}

TEST_CASE("an output that exists has the code exists, and the hint names --force", "[cli]") {
  const ScratchFolder folder;
  const std::string file = folder / "run.viscap";
  write_file(file, "old", false);
  const Json error = error_of({"capture", "--emulate", "--out", file, "--json"});
  CHECK(error["code"] == "exists");
  CHECK(error["hint"].get<std::string>().find("--force") != std::string::npos);
  CHECK(read_file(file) == "old");
}

TEST_CASE("a port that does not exist has the code port and its name", "[cli]") {
  const ScratchFolder folder;
  std::string rig = read_file(demo("01_rig.toml"));
  rig.replace(rig.find("/dev/serial/by-id/stage"), 23, "/dev/viscard-no-port");
  write_file(folder / "rig.toml", rig, false);
  const Json error = error_of({"rig", "check", "--rig", folder / "rig.toml", "--json"});
  CHECK(error["code"] == "port");
  CHECK(error["where"] == "/dev/viscard-no-port");
  CHECK_FALSE(error["hint"].get<std::string>().empty());
}

TEST_CASE("a test that would overload the cell has the code preflight", "[cli]") {
  const ScratchFolder folder;
  write_file(folder / "test.toml",
             "[ramp]\ndepth = \"0.25 mm\"\nduration = \"1 s\"\nhold = \"3 s\"\n", false);
  const Json error = error_of({"capture", "--emulate", "--test", folder / "test.toml", "--out",
                               folder / "run.viscap", "--json"});
  CHECK(error["code"] == "preflight");
  CHECK(error["message"].get<std::string>().find(" N") != std::string::npos);
  CHECK(error["hint"].get<std::string>().find("depth") != std::string::npos);
}

TEST_CASE("a file that is no capture cannot be exported, and the error names it", "[cli]") {
  const ScratchFolder folder;
  const std::string file = folder / "run.viscap";
  write_file(file, std::string(200, 'x'), false);
  CHECK(error_of({"export", file, "--json"})["where"] == file);
  CHECK(error_of({"export", folder / "missing.viscap", "--json"})["code"] == "failed");
}

TEST_CASE("a run that ends early has its result and the error in one object", "[cli][pty]") {
  const ScratchFolder folder;
  write_file(folder / "test.toml",
             "[approach]\nspeed = \"1 mm/s\"\nlimit = \"0.3 mm\"\nbaseline = \"1 s\"\n"
             "[ramp]\ndepth = \"0.13 mm\"\nduration = \"1 s\"\nhold = \"3 s\"\n",
             false);
  const test::CommandOutcome outcome =
      run_command({"capture", "--emulate", "--speed", "50", "--test", folder / "test.toml", "--out",
                   folder / "run.viscap", "--json"});
  INFO(outcome.out << outcome.err);
  CHECK(outcome.status == kFailed);
  const Json object = Json::parse(outcome.out);
  CHECK(object["status"] == "interrupted");
  CHECK(object["error"]["code"] == "device");
  CHECK(object["error"]["where"] == "approach");
  CHECK(object["error"]["message"].get<std::string>().find("nothing was touched") == 0);
  CHECK(object["error"]["hint"].get<std::string>().find("toward_specimen") != std::string::npos);
}

TEST_CASE("message and hint are the two parts of a text for people", "[cli]") {
  const CommandError sentence = command_error("device", "'/dev/x' is gone. Check the 0.5 m cable.");
  CHECK(sentence.message == "'/dev/x' is gone");
  CHECK(sentence.hint == "Check the 0.5 m cable.");
  CHECK(sentence.where == "/dev/x");
  const CommandError clause = command_error("exists", "'a.csv' exists already; pass --force");
  CHECK(clause.message == "'a.csv' exists already");
  CHECK(clause.hint == "pass --force");
  CHECK(command_error("failed", "it failed").hint.empty());
}

TEST_CASE("the place of an error is what its message names, not what its hint recommends",
          "[cli]") {
  const auto where = [](const char* text) { return command_error("failed", text).where; };
  CHECK(where("a.viscap is a table, not a capture; predict --against takes it") == "a.viscap");
  CHECK(where("no file given; usage: viscard fit FILE... [OPTIONS]").empty());
  CHECK(where("there is no command 'fti'; 'viscard --help' lists the commands").empty());
  CHECK(where("the record has no depth; add --depth") == "--depth");
  CHECK(where("a.toml: the section [stage] is missing") == "a.toml");
  CHECK(where("[stage] is given twice") == "[stage]");
}

}  // namespace viscard
