// The examples in data/protocols, run as a user would run them.
#include "io/capture/capture_file.h"
#include "tests/support/run_command.h"
#include "tests/support/scratch_folder.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <fstream>

namespace viscard {
namespace {

using Catch::Matchers::Contains;
using test::run_command;
using test::ScratchFolder;

const std::string kProtocols = std::string(VISCARD_SOURCE_DIR) + "/data/protocols/";

bool has_phase(const CapturedRun& run, const std::string& name) {
  for (const RunEvent& event : run.events) {
    if (event.name == "phase" && event.value == name) return true;
  }
  return false;
}

}  // namespace

TEST_CASE("every example of a protocol runs, and its capture contains the phases", "[cli][pty]") {
  struct Row {
    const char* file;
    const char* phase;
  };
  const Row row =
      GENERATE(Row{"levels", "hold_3"}, Row{"creep", "creep"}, Row{"cycles", "unload_10"},
               Row{"staircase", "hold_9"}, Row{"preload", "preload_hold"});
  const ScratchFolder folder;
  const std::string out = (folder / "run.viscap").string();
  const auto run = run_command({"capture", "--emulate", "--test", kProtocols + row.file + ".toml",
                                "--speed", "500", "--out", out, "--json"});
  INFO(row.file << ": " << run.err);
  REQUIRE(run.status == kDone);
  const CapturedRun captured = read_capture(out);
  CHECK(captured.status == "finished");
  CHECK(has_phase(captured, row.phase));
  CHECK(nlohmann::json::parse(run.out)["readings"]["missing"] == 0);
}

TEST_CASE("a rig file without volts_per_count or with impossible dates is refused by its key",
          "[cli]") {
  const ScratchFolder folder;
  const auto checked = [&](const std::string& cell, const std::string& calibration) {
    std::ofstream(folder / "rig.toml")
        << "[stage]\nport = \"/dev/null\"\n[load_cell]\nport = \"/dev/null\"\n"
        << cell << "[calibration]\nvolts_per_newton = 0.7\ncapacity = 2.45\n"
        << calibration << "[frame]\nstiffness = \"rigid\"\n";
    return run_command({"rig", "check", "--rig", (folder / "rig.toml").string()}).err;
  };
  CHECK_THAT(checked("volts_per_count = 0\n", ""), Contains("load_cell.volts_per_count is 0"));
  CHECK_THAT(checked("", "date = \"yesterday\"\n"), Contains("calibration.date 'yesterday'"));
  CHECK_THAT(checked("", ""), Contains("/dev/null") && !Contains("volts_per_count"));
}

TEST_CASE("rig check judges the calibration as a capture does", "[cli][pty]") {
  const ScratchFolder folder;
  const auto checked = [&](const std::string& date) {
    std::ofstream(folder / "rig.toml")
        << "[calibration]\nvolts_per_newton = 0.7255\ncapacity = 2.4517\n"
        << date << "[frame]\nstiffness = \"rigid\"\n";
    return run_command(
        {"rig", "check", "--emulate", "--seconds", "1", "--rig", (folder / "rig.toml").string()});
  };
  const auto expired = checked("date = 2020-01-15\n");
  CHECK(expired.status == kFailed);
  CHECK_THAT(expired.out, Contains("expired on 2021-01-15") && Contains("not fit for a test"));
  const auto undated = checked("");
  CHECK(undated.status == kDone);
  CHECK_THAT(undated.out, Contains("has no date"));
  const auto future = checked("date = 9999-01-15\n");
  CHECK(future.status == kFailed);
  CHECK_THAT(future.out, Contains("later than today"));
}

TEST_CASE(
    "an expired calibration is refused before any port is opened, unless --uncalibrated is given",
    "[cli]") {
  const ScratchFolder folder;
  std::ofstream(folder / "rig.toml")
      << "[stage]\nport = \"/dev/null\"\n[load_cell]\nport = \"/dev/null\"\nvolts_per_count = "
         "1e-6\n"
         "[calibration]\nvolts_per_newton = 0.7\ncapacity = 2.45\nid = \"old\"\ndate = 2020-01-15\n"
         "[frame]\nstiffness = \"10 N/mm\"\n";
  const std::string demo = std::string(VISCARD_SOURCE_DIR) + "/data/demo/";
  std::vector<std::string> words{"capture",
                                 "--rig",
                                 (folder / "rig.toml").string(),
                                 "--test",
                                 demo + "02_test.toml",
                                 "--specimen",
                                 demo + "03_pdms_1to10.toml",
                                 "--out",
                                 (folder / "run.viscap").string()};
  const auto refused = run_command(words);
  CHECK(refused.status == kFailed);
  CHECK_THAT(refused.err, Contains("expired on 2021-01-15") && Contains("viscard calibrate"));
  words.emplace_back("--uncalibrated");
  const auto told = run_command(words);
  CHECK(told.status == kFailed);
  CHECK_THAT(told.err, Contains("/dev/null"));  // it came as far as the ports
}

}  // namespace viscard
