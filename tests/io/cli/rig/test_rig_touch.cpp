// viscard rig touch, faults of the emulated rig on the command line, and doubts that come first.
#include "io/basics/atomic_file.h"
#include "io/config/config_file.h"
#include "io/flow/rig_actions.h"
#include "rig/emulator/demo_rig.h"
#include "rig/emulator/emulated_rig.h"
#include "tests/support/error_text.h"
#include "tests/support/run_command.h"
#include "tests/support/scratch_folder.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace viscard {
namespace {

using test::contains;
using test::run_command;
using test::ScratchFolder;

constexpr const char* kShortTest = R"(
[approach]
speed = "0.2 mm/s"
baseline = "1 s"
[ramp]
depth = "0.13 mm"
duration = "1 s"
hold = "3 s"
[recovery]
hold = "2 s"
)";

test::CommandOutcome capture_with(const ScratchFolder& folder, const std::string& fault,
                                  const std::string& more = "--json") {
  const std::string test_file = folder / "test.toml";
  write_file(test_file, kShortTest, false);
  return run_command({"capture", "--emulate", "--speed", "200", "--test", test_file, "--fault",
                      fault, "--out", (folder / "run.viscap").string(), more});
}

}  // namespace

TEST_CASE("a touch of the load cell is waited for, and its day is written into the rig file only",
          "[cli][rig][pty]") {
  const auto touched = run_command({"rig", "touch", "--emulate", "--json"});
  INFO(touched.err);
  REQUIRE(touched.status == kDone);
  const auto json = nlohmann::json::parse(touched.out);
  CHECK(json["force_N"].get<double>() == Approx(0.245).epsilon(0.02));  // a tenth of the capacity

  const ScratchFolder folder;
  const std::string before =
      "# mine\n[stage]\nport = \"a\"\n[load_cell]  # the cell\nport = \"b\"\n";
  write_file(folder / "rig.toml", before, false);
  write_answer(folder / "rig.toml", "2026-11-28");
  write_answer(folder / "rig.toml", "2026-11-29");
  CHECK(read_file(folder / "rig.toml") ==
        "# mine\n[stage]\nport = \"a\"\n[load_cell]  # the cell\nanswered_on = 2026-11-29\n"
        "port = \"b\"\n");
  write_file(folder / "none.toml", "[stage]\n", false);
  CHECK_THROWS_WITH(write_answer(folder / "none.toml", "2026-11-28"),
                    Catch::Contains("no section [load_cell]"));
}

TEST_CASE("a zero of positions stands in the rig file, and moves are counted from it too",
          "[cli][rig][pty]") {
  const ScratchFolder folder;
  const std::string file = folder / "rig.toml";
  std::string text = read_file(VISCARD_SOURCE_DIR "/data/demo/01_rig.toml");
  const std::string grbl = "driver = \"grbl\"";
  write_file(file, text, false);
  const std::vector<std::string> set_zero{"rig", "set-zero", "--emulate", "--rig", file};
  const auto refused = run_command(set_zero);
  CHECK(refused.status == kFailed);
  CHECK(contains(refused.err, "the stage with driver 'grbl' cannot keep a zero"));
  CHECK(contains(refused.err, "restarts when the port is opened"));

  text.replace(text.find(grbl), grbl.size(), "driver = \"zaber\"\nmicrostep = \"0.047625 um\"");
  write_file(file, text, true);
  const auto here = run_command(set_zero);
  INFO(here.err);
  CHECK(here.status == kDone);
  CHECK(contains(here.out, "positions count from here, 0.000 mm of the controller"));
  CHECK(read_file(file) == text);  // that of an emulated stage is kept nowhere

  write_zero(file, 0.5e-3);
  write_zero(file, 0.25e-3);
  CHECK(contains(read_file(file), "[stage]\nzero = \"0.250000 mm\"\n"));
  CHECK_FALSE(contains(read_file(file), "0.500000"));
  CHECK(read_rig(file).stage.zero_m == Approx(0.25e-3).epsilon(1e-12));
  const auto moved = run_command({"rig", "jog", "--emulate", "--rig", file, "--away", "0.1 mm"});
  INFO(moved.err);
  CHECK(contains(moved.out, "to -0.100 mm (-0.350 mm from your zero)"));

  CHECK(run_command({"rig", "set-zero", "--emulate"}).status == kBadWords);
  CHECK(run_command({"rig", "set-zero", "--rig", file, "--limit", "1 N"}).status == kBadWords);
}

TEST_CASE("a zero that was refused to a locked stage is refused again", "[rig][pty]") {
  EmulatedRigOptions options;
  options.truth = demo_truth(10.0, 1);
  options.config = demo_rig();
  options.grbl.is_homing_enabled = true;
  options.resets_on_open = false;
  options.is_on_wall_clock = true;  // its ports are opened as those of a real rig
  const EmulatedRig emulated(options);
  for (int i = 0; i < 2; ++i) {
    CHECK_THROWS_WITH(lasting_position_m(emulated.config(), false),
                      Catch::Contains("cannot keep a zero for the next command"));
  }
}

TEST_CASE("only an instrument that has a zero of its own is zeroed", "[cli][rig][pty]") {
  const auto refused = run_command({"rig", "zero-force", "--emulate"});
  CHECK(refused.status == kFailed);
  CHECK(contains(refused.err, "driver 'hx711' has no zero that this program can set"));
  CHECK(run_command({"rig", "zero-force"}).status == kBadWords);
}

TEST_CASE("the day of an answer is read from the rig file, and another text is refused",
          "[cli][rig]") {
  std::string rig = read_file(VISCARD_SOURCE_DIR "/data/demo/01_rig.toml");
  const std::string section = "[load_cell]\n";
  const auto with = [&](const std::string& line) {
    std::string text = rig;
    text.insert(text.find(section) + section.size(), line + "\n");
    return text;
  };
  CHECK(rig_from_toml(with("answered_on = 2026-11-28"), "rig").load_cell.answered_on ==
        "2026-11-28");
  CHECK_THROWS_WITH(rig_from_toml(with("answered_on = \"yes\""), "rig"),
                    Catch::Contains("load_cell.answered_on is 'yes'"));
}

TEST_CASE("a fault of the emulated rig ends the capture with status 1 and its name",
          "[cli][capture][pty]") {
  const ScratchFolder folder;
  const auto run = capture_with(folder, "frozen@ramp+0.4");
  CHECK(run.status == kFailed);
  const auto json = nlohmann::json::parse(run.out);
  CHECK(json["status"] == "interrupted");
  CHECK(json["error"]["code"] == "cell-dead");
  CHECK(contains(json["reason"].get<std::string>(), "frozen"));
}

TEST_CASE("a doubtful run says so in its first line, and its doubts come before its values",
          "[cli][capture][pty]") {
  const ScratchFolder folder;
  const auto run = capture_with(folder, "lost-steps@ramp", "--force");
  INFO(run.out << run.err);
  CHECK(run.status == kDone);
  CHECK(contains(run.out.substr(0, run.out.find('\n')), "finished, doubtful"));
  CHECK(run.out.find("lost steps") < run.out.find("peak force"));
}

TEST_CASE("an unknown fault, and a fault of a real rig, are wrong words", "[cli][capture]") {
  const ScratchFolder folder;
  const auto unknown = capture_with(folder, "melted");
  CHECK(unknown.status == kBadWords);
  CHECK(contains(unknown.err, "melted"));
  CHECK(contains(unknown.err, "known are frozen"));
  const auto real = run_command({"capture", "--fault", "frozen", "--out", "x.viscap"});
  CHECK(real.status == kBadWords);
  CHECK(contains(real.err, "--fault"));
}

TEST_CASE("a fault in no phase of the test, or after its phase, is refused before the run",
          "[cli][capture]") {
  const std::vector<std::pair<std::string, std::string>> cases{
      {"frozen@hld", "this test has no phase 'hld'; did you mean 'hold'? It has connect, tare, "},
      {"frozen@Hold+1", "did you mean 'hold'?"},
      {"dead-motor@recovry", "did you mean 'recovery'?"},
      {"zeros@cycle_99", "this test has no phase 'cycle_99'. It has connect, "},
      {"frozen@hold+1000",
       "fault 'frozen@hold+1000' comes too late: the phase 'hold' of this test lasts 3 s"},
      {"frozen@ramp+1.5", "lasts 1 s"}};
  for (const auto& [fault, text] : cases) {
    const ScratchFolder folder;
    const auto run = capture_with(folder, fault);
    CAPTURE(fault, run.err);
    CHECK(run.status == kBadWords);
    CHECK(contains(run.err, text));
    CHECK_FALSE(std::filesystem::exists(folder / "run.viscap"));
  }
}

TEST_CASE("a fault that the run ends before is reported as never reached", "[cli][capture][pty]") {
  const ScratchFolder folder;
  const auto run = capture_with(folder, "frozen@retract+1000");
  CAPTURE(run.err);
  CHECK(run.status == kDone);
  CHECK(contains(run.err, "the fault 'frozen' was never reached"));
  const ScratchFolder other;
  CHECK_FALSE(contains(capture_with(other, "lost-steps@ramp").err, "never reached"));
}

TEST_CASE("a move by hand reports how far it is", "[rig][pty]") {
  StageOrder order;
  order.toward_m = -1e-3;
  order.limit_N = 0.1;
  std::vector<double> fractions;
  RunControl control;
  control.progress = [&](const RunProgress& now) {
    if (now.phase == kMovePhase) fractions.push_back(now.fraction);
  };
  move_rig_stage(demo_rig(), true, order, control);
  REQUIRE_FALSE(fractions.empty());
  CHECK(fractions.front() < 0.6);  // of 1 s of readings before, and 6 s from then on
}

}  // namespace viscard
