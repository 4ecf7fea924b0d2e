// The examples in data/protocols, run as a user would run them.
#include "io/capture_file.h"
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

TEST_CASE("Every example of a protocol runs, and its capture carries the phases", "[cli][pty]") {
  struct Row {
    const char* file;
    const char* phase;
  };
  const Row row =
      GENERATE(Row{"levels", "hold_3"}, Row{"creep", "creep"}, Row{"cycles", "unload_10"},
               Row{"staircase", "hold_9"}, Row{"preload", "preload_hold"});
  const ScratchFolder folder;
  const std::string out = (folder / "run.viscap").string();
  // Creep needs several exchanges with the stage in each emulated second.
  const std::string speed = std::string(row.file) == "creep" ? "50" : "150";
  const auto run = run_command({"capture", "--emulate", "--test", kProtocols + row.file + ".toml",
                                "--speed", speed, "--out", out, "--json"});
  INFO(row.file << ": " << run.err);
  REQUIRE(run.status == kDone);
  const CapturedRun captured = read_capture(out);
  CHECK(captured.status == "finished");
  CHECK(has_phase(captured, row.phase));
  CHECK(nlohmann::json::parse(run.out)["readings"]["missing"] == 0);
}

TEST_CASE("An expired calibration is refused before any port is opened, unless told otherwise",
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
