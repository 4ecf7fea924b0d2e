#include "io/basics/atomic_file.h"
#include "io/basics/number_text.h"
#include "io/cli/words/command_line.h"
#include "models/maths/failure_text.h"
#include "tests/support/error_text.h"
#include "tests/support/run_command.h"
#include "tests/support/scratch_folder.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cerrno>
#include <cstdlib>

namespace viscard {
namespace {

using test::contains;
using test::run_command;

bool is_one_line(const std::string& text) {
  return std::count(text.begin(), text.end(), '\n') == 1 && text.back() == '\n';
}

TEST_CASE("a lack of threads is stated as one of memory, which may pass", "[cli]") {
  const std::system_error error(EAGAIN, std::generic_category());
  CHECK(is_lack_of_memory(error));
  CHECK(failure_text(error, "this").starts_with("memory does not suffice for this"));
  CHECK_FALSE(is_lack_of_memory(std::system_error(ENOSPC, std::generic_category())));
}

TEST_CASE("only what is refused in words is an answer of a search", "[cli]") {
  CHECK(is_refusal(std::runtime_error("the pillar buckles")));
  CHECK(is_refusal(std::invalid_argument("nu")));
  CHECK_FALSE(is_refusal(std::logic_error("a slip of the program")));
  CHECK_FALSE(is_passing(std::logic_error("a slip of the program")));
  const auto passes = [](const std::exception& error) {
    return is_passing(error) && !is_refusal(error);
  };
  CHECK(passes(std::bad_alloc()));
  CHECK(passes(std::system_error(ENOSPC, std::generic_category())));
  CHECK(passes(NotEnoughMemory("the next mesh is too large")));
  CHECK(passes(StopsWork("it was interrupted")));
}

TEST_CASE("a cell of a table is no formula of a spreadsheet", "[cli]") {
  CHECK(csv_cell("=HYPERLINK(\"x\")") == "\"'=HYPERLINK(\"\"x\"\")\"");
  for (const char* formula : {"@x", "+x", "-x", "-", "\t=1"})
    CHECK(csv_cell(formula).starts_with("\"'"));
  for (const char* plain : {"", "a=b", "-5 um", "+.5", "-.5"})
    CHECK(csv_cell(plain) == "\"" + std::string(plain) + "\"");
}

TEST_CASE("the overview lists every command in the order of the flow", "[cli]") {
  const auto help = run_command({"--help"});
  CHECK(help.status == kDone);
  CHECK(help.err.empty());
  std::size_t last = 0;
  for (const Command& command : commands()) {
    const std::size_t at = help.out.find("\n  " + std::string(command.name) + " ");
    CAPTURE(command.name);
    REQUIRE(at != std::string::npos);
    CHECK(at > last);
    last = at;
  }
  const std::vector<std::string> flow{"capture", "calibrate", "export", "fit",
                                      "card",    "validate",  "plan",   "simulate",
                                      "cost",    "report",    "demo"};
  std::size_t place = 0;
  for (const Command& command : commands()) {
    const auto found = std::find(flow.begin(), flow.end(), std::string(command.name));
    if (found == flow.end()) continue;  // a later command outside the flow
    const auto here = static_cast<std::size_t>(found - flow.begin());
    CHECK(here >= place);
    place = here;
  }
  CHECK(run_command({"help"}).out == help.out);
}

TEST_CASE("without a command the overview goes to stderr and the status is 2", "[cli]") {
  const auto nothing = run_command({});
  CHECK(nothing.status == kBadWords);
  CHECK(nothing.out.empty());
  CHECK(contains(nothing.err, "usage: viscard COMMAND"));
  CHECK(contains(nothing.err, "viscard demo --out demo"));  // where to begin
}

TEST_CASE("the version is one line", "[cli]") {
  // As semver.org 2.0.0, item 10: the commit, or words in its place.
  const std::string out = run_command({"--version"}).out;
  const std::string release = "viscard " VISCARD_VERSION "+";
  REQUIRE(out.rfind(release, 0) == 0);
  CHECK(out.size() > release.size() + 1);
  CHECK(out.find_first_not_of("0123456789abcdefghijklmnopqrstuvwxyz.\n", release.size()) ==
        std::string::npos);
  CHECK(is_one_line(out));
  const auto json = nlohmann::json::parse(run_command({"--version", "--json"}).out);
  CHECK(json.at("schema") == "viscard-version/1");
  CHECK(json.at("version") == VISCARD_VERSION);
  CHECK("viscard " + json.at("source").get<std::string>() + "\n" == out);
}

TEST_CASE("a misspelt command gives one line with the nearest command, and status 2", "[cli]") {
  const auto outcome = run_command({"exprot", "run.viscap"});
  CHECK(outcome.status == kBadWords);
  CHECK(outcome.out.empty());
  CHECK(is_one_line(outcome.err));
  CHECK(contains(outcome.err, "there is no command 'exprot'; did you mean 'export'?"));
  CHECK(contains(run_command({"FIT", "a.csv"}).err, "did you mean 'fit'?"));
}

TEST_CASE("every command explains itself with an example of its own", "[cli]") {
  REQUIRE(commands().size() >= 3);
  for (const Command& command : commands()) {
    const std::string name = command.name;
    CAPTURE(name);
    const auto help = run_command({name, "--help"});
    CHECK(help.status == kDone);
    CHECK(help.err.empty());
    CHECK(contains(help.out, "usage: viscard " + name));
    CHECK(contains(help.out, "\nExample: viscard " + name));
    CHECK(contains(help.out, "--json"));
    CHECK(run_command({name, "-h"}).out == help.out);
    CHECK(std::string(command.summary).size() > 5);
  }
}

TEST_CASE("the options in every example exist", "[cli]") {
  for (const Command& command : commands()) {
    const auto help = run_command({command.name, "--help"});
    const std::size_t at = help.out.find("\nExample: ");
    REQUIRE(at != std::string::npos);
    std::istringstream example(help.out.substr(at + 10));
    const std::string before = help.out.substr(0, at);
    for (std::string word; example >> word;) {
      if (word.rfind("--", 0) != 0) continue;
      CAPTURE(command.name, word);
      CHECK(contains(before, word.substr(0, word.find('='))));
    }
  }
}

TEST_CASE("a misspelt option gives one line with the nearest option, and status 2", "[cli]") {
  for (const Command& command : commands()) {
    CAPTURE(command.name);
    for (const char* option : {"--jsno", "--no-such-option-at-all"}) {
      const auto outcome = run_command({command.name, option});
      CAPTURE(outcome.err);
      CHECK(outcome.status == kBadWords);
      CHECK(outcome.out.empty());
      CHECK(is_one_line(outcome.err));
      CHECK(contains(outcome.err, std::string("there is no option '") + option + "'"));
    }
    CHECK(contains(run_command({command.name, "--jsno"}).err, "did you mean '--json'?"));
  }
}

TEST_CASE("an option with an empty value is refused before any work, with status 2", "[cli]") {
  const std::vector<std::vector<std::string>> lines{
      {"fit", "missing.csv", "--out"},
      {"fit", "missing.csv", "--terms"},
      {"card", "m.json", "--for"},
      {"predict", "m.json", "--against"},
      {"simulate", "s.toml", "--out"},
      {"sweep", "s.toml", "--csv"},
      {"report", "m.json", "--out", "r.html", "--logo"},
      {"calibrate", "--data", "w.csv", "--id"}};
  for (std::vector<std::string> words : lines) {
    const std::string option = words.back();
    words.emplace_back("");
    CAPTURE(words);
    const auto outcome = run_command(words);
    CHECK(outcome.status == kBadWords);
    CHECK(contains(outcome.err, option + " is empty, as by a variable that is not set"));
  }
}

TEST_CASE("a number that cannot be read is refused with option, value and what is expected",
          "[cli]") {
  const std::string scene = VISCARD_SOURCE_DIR "/data/scenes/pillar_modal.toml";
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases{
      {{"fit", "a.csv", "--terms", "x"}, "--terms cannot be 'x'; expected a whole number"},
      {{"fit", "a.csv", "--max-terms=1.5"}, "--max-terms cannot be '1.5'; expected a whole number"},
      {{"fit", "a.csv", "--ratio", "a"}, "--ratio cannot be 'a'; expected a number without unit"},
      {{"simulate", scene, "--tol", "3kg"},
       "--tol cannot be '3kg'; expected a number without unit"},
      {{"capture", "--emulate", "--seed", "-3"},
       "--seed cannot be '-3'; expected a whole number from 0 on"},
      {{"simulate", scene, "--samples=-2"}, "--samples cannot be '-2'; expected a whole number"},
      {{"demo", "--speed", "x"}, "--speed cannot be 'x'; expected a number"},
      {{"demo", "--speed", "0"}, "--speed is 0; it must be above 0 and at most 500"},
      {{"rig", "lift", "--emulate", "--away=-3mm"}, "--away is '-3mm'; it must be above 0"},
      {{"rig", "jog", "--emulate", "--toward=-1mm"}, "--toward is '-1mm'; it must be above 0"},
      {{"rig", "jog", "--emulate", "--away", "1"},
       "--away is '1', without a unit and so in m; it must be above 0 and at most 100 mm"},
      {{"rig", "jog", "--emulate", "--away", "1 mm", "--speed", "0.2"},
       "--speed is '0.2', without a unit and so in m/s; it must be above 0 and at most 10 mm/s"},
      {{"fit", "a.viscap", "--want", "g_2=abc"},
       "--want is 'g_2=abc'; after the equals sign expected a share, such as 5%"},
      {{"fit", "a.csv", "--time-zero", "q"}, "--time-zero: 'q' does not begin with a number"}};
  for (const auto& [words, text] : cases) {
    CAPTURE(words);
    const auto outcome = run_command(words);
    CHECK(outcome.status == kBadWords);
    CHECK(contains(outcome.err, text));
  }
}

TEST_CASE("a wrong subcommand is named, with the nearest one", "[cli]") {
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases{
      {{"scene", "chekc", "x.toml"}, "there is no 'viscard scene chekc'; did you mean 'check'?"},
      {{"scene"}, "viscard scene needs a word more; there are: check"},
      {{"rig", "lits"}, "there is no 'viscard rig lits'; did you mean 'list'?"},
      {{"card", "check", "m.json"},
       "there is no 'viscard card check'; did you mean 'viscard card --check'?"},
      {{"predict", "m.json", "m.json"}, "too many words on the command line, from 'm.json' on"},
      {{"plan", "a.toml", "b.toml"}, "too many words on the command line, from 'b.toml' on"},
      {{"help", "fti"}, "there is no command 'fti'; did you mean 'fit'?"},
      {{"help", "scene", "chekc"}, "there is no 'scene chekc'; did you mean 'check'?"},
      {{"help", "fit", "check"}, "viscard fit has no subcommands; write viscard help fit"},
      {{"help", "nix"}, "there is no command 'nix'; 'viscard help' lists"},
      {{"fit", "a.csv", "--model", "nope"}, "ogden-3"}};
  for (const auto& [words, text] : cases) {
    CAPTURE(words);
    const auto outcome = run_command(words);
    CHECK(outcome.status == kBadWords);
    CHECK(contains(outcome.err, text));
  }
}

TEST_CASE("help of a subcommand is that of its command", "[cli]") {
  const auto outcome = run_command({"help", "scene", "check"});
  CHECK(outcome.status == kDone);
  CHECK(outcome.out == run_command({"help", "scene"}).out);
}

TEST_CASE("a shortened option is refused", "[cli]") {
  for (const Command& command : commands()) {
    CAPTURE(command.name);
    CHECK(run_command({command.name, "--hel"}).status == kBadWords);
  }
}

TEST_CASE("a command that fails prints no result on stdout, and with --json at most the error",
          "[cli]") {
  for (const Command& command : commands()) {
    const std::string name = command.name;
    if (name == "demo" || name == "capture") continue;  // they take no input file
    CAPTURE(name);
    const auto outcome = run_command({name, "--json", "/nowhere/no-such-file"});
    CHECK(outcome.status != kDone);
    CHECK(is_one_line(outcome.err));
    const auto json = nlohmann::json::parse(outcome.out);
    CHECK(json.size() == 3);
    CHECK(json.at("schema") == "viscard-error/1");
    CHECK(json.at("version") == VISCARD_VERSION);
    CHECK(json.at("error").at("code").is_string());
    CHECK(json.at("error").at("message").is_string());
  }
}

TEST_CASE("command lines are recorded quoted for a shell", "[cli]") {
  CHECK(quoted_command_line("fit", {"a b.csv", "--column", "time_s=Time (s)", "it's", ""}) ==
        "viscard fit 'a b.csv' --column 'time_s=Time (s)' 'it'\\''s' ''");
}

TEST_CASE("a word @FILE stands for the words in that file, one a line", "[cli]") {
  const test::ScratchFolder scratch;
  const std::string kept = "@" + (scratch / "a.options").string();
  const std::string table = VISCARD_SOURCE_DIR "/data/demo/example_relaxation.csv";
  write_file(scratch / "a.options", "# of a table\n--terms=1\n\n--column=time_s=t [s]\r\n", false);
  const auto typed = run_command({"fit", table, "--terms=1", "--column=time_s=t [s]"});
  CHECK(typed.status == kDone);
  CHECK(run_command({"fit", table, kept}).out == typed.out);
  CHECK(run_command({"fit", table, "@" + (scratch / "none").string()}).status == kFailed);
}

TEST_CASE("an output that cannot be written is a failure of the program", "[cli]") {
  const std::string program = VISCARD_PROGRAM;
  CHECK(std::system((program + " --help > /dev/null").c_str()) == 0);
  const int status = std::system((program + " --help > /dev/full 2> /dev/null").c_str());
  CHECK(WEXITSTATUS(status) == kFailed);
}

TEST_CASE("a message does not repeat megabytes of what somebody wrote", "[cli]") {
  const std::string file = std::string(1'000'000, 'x') + ".csv";
  const test::CommandOutcome plain = run_command({"fit", file});
  CHECK(plain.status == 1);
  CHECK(plain.err.size() < 1500);
  CHECK_THAT(plain.err, Catch::Contains("xxxx") && Catch::Contains("more bytes"));
  CHECK(shortened("a " + std::string(1000, 'b') + " c") ==
        "a " + std::string(60, 'b') + "... (941 more bytes) c");
}

}  // namespace
}  // namespace viscard
