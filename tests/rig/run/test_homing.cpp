// home = true: the stage is homed after the lift, and its count compared with its switch.
#include "rig/run/count_comparison.h"
#include "tests/rig/rig_fixture.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <variant>

namespace viscard {
namespace {

using Catch::Matchers::Contains;

// A GRBL that homes one axis, with a switch that stops it.
EmulatedRigOptions homing_rig() {
  EmulatedRigOptions options = RigFixture::options();
  options.config.stage.home = true;
  options.grbl.is_homing_enabled = true;
  options.grbl.has_hard_limits = true;
  return options;
}

EmulatedRigOptions homing_rig_that_loses_steps() {
  EmulatedRigOptions options = homing_rig();
  options.fault.kind = RigFaultKind::kLostSteps;
  return options;
}

// Without an unloading in contact, so that only homing can show lost steps.
TestPlan one_level() {
  TestPlan plan = short_plan();
  plan.protocol = "levels";
  plan.levels = {{0.13e-3, 1.0, 2.0}};
  return plan;
}

int homings_sent(const RigFixture& rig) {
  int n = 0;
  for (const RawBytes& raw : rig.all<RawBytes>()) {
    if (raw.is_sent && raw.bytes == "$HZ\n") ++n;
  }
  return n;
}

std::string value_of(const RigFixture& rig, const std::string& event) {
  std::string value;
  for (const RunEvent& one : rig.all<RunEvent>()) {
    if (one.name == event) value = one.value;
  }
  return value;
}

// A run with drivers of its own on the lines of the rig, as each capture of a series has.
RunOutcome run_of_series(RigFixture& rig, std::optional<HomedStage> before, bool is_last) {
  GrblStage stage(rig.stage_line, rig.config.stage, rig.clock, rig.sink);
  Hx711LoadCell load_cell(rig.cell_line, rig.config.load_cell, rig.clock, rig.sink);
  RunControl control;
  control.clock = &rig.clock;
  control.homed_before = before;
  control.homes_after = is_last;
  return run_indentation(stage, load_cell, rig.config, one_level(), demo_specimen(10.0), rig.sink,
                         control);
}

TEST_CASE("a stage that loses every fifth step under load is a doubt with the size of the loss",
          "[rig][pty]") {
  RigFixture rig(homing_rig_that_loses_steps());
  const RunOutcome outcome = rig.run(one_level());
  INFO(outcome.reason);
  REQUIRE(outcome.status == "finished");
  REQUIRE(outcome.doubts.size() == 1);
  CAPTURE(outcome.doubts.front());
  const double lost_m = rig.emulated.outcome().lost_m;
  REQUIRE(lost_m > 15e-6);
  REQUIRE(outcome.count);
  CHECK(outcome.count->off_m == Approx(lost_m).margin(2e-6));
  const double steps_per_m = RigFixture::options().truth.steps_per_m;
  CHECK(outcome.count->steps == Approx(lost_m * steps_per_m).margin(2e-6 * steps_per_m));
  CHECK_THAT(outcome.doubts.front(), Contains("has lost steps while it pressed") &&
                                         Contains(" um (") && Contains(" steps) further from"));
  CHECK(rig.has_event("doubt", "lost_steps"));
  CHECK(outcome.depth_is == "counted");
  CHECK(value_of(rig, "depth") == "counted");
}

TEST_CASE("a healthy stage is homed alone after the lift and gives no doubt", "[rig][pty]") {
  RigFixture rig(homing_rig());
  const RunOutcome outcome = rig.run(short_plan());
  INFO(outcome.reason);
  REQUIRE(outcome.status == "finished");
  CHECK(outcome.doubts.empty());
  REQUIRE(outcome.count);
  CHECK(std::abs(outcome.count->off_m) <= outcome.count->within_m);
  CHECK(outcome.depth_is == "compared");
  CHECK(value_of(rig, "depth") == "compared");
  CHECK(homings_sent(rig) == 3);  // before, after, and once more to leave the switch
  CHECK(rig.all<RunEvent>().back().name == "finished");
  // It stands where it was homed, off the switch and far from the specimen.
  CHECK(rig.emulated.outcome().final_position_m < 0.0);
}

TEST_CASE("a test whose stage fails to home is not run", "[rig][pty]") {
  EmulatedRigOptions options = homing_rig();
  options.grbl.fail_homing_number = 1;
  RigFixture rig(options);
  CHECK_THROWS_WITH(rig.run(one_level()), Contains("alarm 8") && Contains("not homed"));
  CHECK(homings_sent(rig) == 1);
  CHECK_FALSE(rig.has_event("phase", "tare"));
  CHECK_FALSE(rig.has_event("stage_unlocked", ""));
}

TEST_CASE("a homing that fails after the lift is a doubt with its alarm", "[rig][pty]") {
  EmulatedRigOptions options = homing_rig();
  options.grbl.fail_homing_number = 2;
  options.grbl.homing_alarm = 9;
  RigFixture rig(options);
  const RunOutcome outcome = rig.run(one_level());
  INFO(outcome.reason);
  CHECK(outcome.status == "finished");
  REQUIRE(outcome.doubts.size() == 1);
  CHECK_THAT(outcome.doubts.front(), Contains("could not be homed") && Contains("alarm 9"));
  CHECK(homings_sent(rig) == 2);
  CHECK_FALSE(outcome.count);
}

TEST_CASE("after a doubtful run the stage is not homed", "[rig][pty]") {
  EmulatedRigOptions lossy = homing_rig_that_loses_steps();
  lossy.truth.material.terms.clear();  // an elastic specimen: its unloading shows the loss
  RigFixture doubtful(lossy);
  const RunOutcome outcome = doubtful.run(short_plan());
  INFO(outcome.reason);
  REQUIRE(outcome.status == "finished");
  REQUIRE_FALSE(outcome.doubts.empty());
  CHECK_THAT(outcome.doubts.front(), Contains("after an unloading"));
  CHECK_FALSE(outcome.count);
  CHECK(homings_sent(doubtful) == 1);  // before the test
  CHECK_FALSE(doubtful.has_event("phase", kHomePhase));
}

TEST_CASE(
    "Ctrl-C and a force limit while the stage is homed after the lift end the run as in a test",
    "[rig][pty]") {
  RigFixture rig(homing_rig());
  std::string status = "interrupted", code = "interrupted", cause = "the run was interrupted";
  SECTION("Ctrl-C on the way to the switch") {
    when_phase(rig, kHomePhase, [&] { rig.stop = true; });
  }
  // During the homing cycle after the test, which is the second one.
  int n_homings = 0;
  std::function<void()> in_cycle;
  rig.on_record = [&](const RunRecord& record) {
    const auto* raw = std::get_if<RawBytes>(&record);
    if (raw == nullptr || !raw->is_sent || raw->bytes != "$HZ\n") return;
    if (++n_homings == 2 && in_cycle) in_cycle();
  };
  SECTION("Ctrl-C in the homing cycle") {
    in_cycle = [&] { rig.stop = true; };
  }
  SECTION("a force, in two steps that are no jump") {
    const double limit_N = rig.config.safety.soft_fraction * rig.config.calibration.capacity_N;
    when_phase(rig, kHomePhase, [&rig, limit_N] { rig.emulated.hang_weight(0.6 * limit_N); });
    in_cycle = [&rig, limit_N] { rig.emulated.hang_weight(1.05 * limit_N); };
    status = "stopped";
    code = "force-limit";
    cause = " N, while the stage was homed after the test";
  }
  const RunOutcome outcome = rig.run(short_plan());
  CAPTURE(outcome.reason);
  CHECK(outcome.status == status);
  CHECK(outcome.code == code);
  CHECK(outcome.phase == kHomePhase);
  CHECK_THAT(outcome.reason, Contains("The test was complete; the stage was stopped while it was "
                                      "homed, after a lift to") &&
                                 Contains("above the contact"));
  CHECK_THAT(outcome.cause, Contains(cause));
  CHECK(outcome.doubts.empty());
  CHECK(outcome.depth_is == "counted");
  CHECK_FALSE(outcome.count);
  CHECK(homings_sent(rig) < 3);
  CHECK_FALSE(rig.emulated.outcome().is_moving);
  CHECK(rig.all<RunEvent>().back().name == status);
}

TEST_CASE("a homing that a person stops leaves the stage locked", "[rig][pty]") {
  RigFixture rig(homing_rig());
  rig.on_record = [&](const RunRecord& record) {
    const auto* raw = std::get_if<RawBytes>(&record);
    if (raw != nullptr && raw->is_sent && raw->bytes == "$HZ\n") rig.stop = homings_sent(rig) == 2;
  };
  const RunOutcome outcome = rig.run(short_plan());
  CHECK(outcome.status == "interrupted");
  std::string last;
  for (const RawBytes& raw : rig.all<RawBytes>()) {
    if (raw.is_sent && raw.bytes.front() == '$') last = raw.bytes;
  }
  CHECK(last == "$HZ\n");
  CHECK_FALSE(rig.emulated.outcome().is_moving);
}

TEST_CASE("a homing cycle stops when the cable of the load cell is pulled", "[rig][pty]") {
  const int in_homing = GENERATE(1, 2);
  RigFixture rig(homing_rig());
  rig.on_record = [&](const RunRecord& record) {
    const auto* raw = std::get_if<RawBytes>(&record);
    if (raw == nullptr || !raw->is_sent || raw->bytes != "$HZ\n") return;
    if (homings_sent(rig) == in_homing) rig.emulated.cause(Incident::kPullLoadCellCable);
  };
  if (in_homing == 1) {
    CHECK_THROWS_AS(rig.run(short_plan()), PortHungUp);
  } else {
    const RunOutcome outcome = rig.run(short_plan());
    INFO(outcome.reason);
    CHECK(outcome.status == "interrupted");
    CHECK(outcome.code == "device-lost");
    CHECK(outcome.phase == kHomePhase);
    CHECK(outcome.doubts.empty());
  }
  for (const double until_s = rig.clock.now_s() + 1.0; rig.clock.now_s() < until_s;) {
    wait_readable({&rig.stage_line}, rig.clock, 0.002);
    rig.stage_line.read_available();
  }
  CHECK_FALSE(rig.emulated.outcome().is_moving);
  CHECK(std::abs(rig.emulated.outcome().final_position_m - kHomeAt_m) > 0.1e-3);
}

TEST_CASE("a load cell that falls silent while the stage is homed after the lift ends the run",
          "[rig][pty]") {
  RigFixture rig(homing_rig());
  when_phase(rig, kHomePhase, [&] { rig.emulated.cause(Incident::kSilenceLoadCell); });
  const RunOutcome outcome = rig.run(short_plan());
  CHECK(outcome.status == "interrupted");
  CHECK_THAT(outcome.reason, Contains("fell silent") && !Contains("could not be homed"));
  CHECK(outcome.doubts.empty());
  CHECK_FALSE(rig.emulated.outcome().is_moving);
}

TEST_CASE("a series homes before its first run and after its last one only", "[rig][pty]") {
  RigFixture rig(homing_rig_that_loses_steps());
  const RunOutcome first = run_of_series(rig, std::nullopt, false);
  INFO(first.reason);
  REQUIRE(first.status == "finished");
  CHECK(first.doubts.empty());
  REQUIRE(first.homed);
  CHECK(homings_sent(rig) == 1);
  const double lost_before_m = rig.emulated.outcome().lost_m;
  const RunOutcome last = run_of_series(rig, first.homed, true);
  INFO(last.reason);
  REQUIRE(last.count);
  CHECK(homings_sent(rig) == 3);
  CHECK(last.count->off_m == Approx(rig.emulated.outcome().lost_m).margin(2e-6));
  CHECK(last.count->off_m > lost_before_m + 15e-6);  // of both runs
  CHECK(last.doubts.size() == 1);
}

TEST_CASE("a controller that restarts within a series has lost its count, and the run is refused",
          "[rig][pty]") {
  RigFixture rig(homing_rig());
  const RunOutcome first = run_of_series(rig, std::nullopt, false);
  REQUIRE(first.homed);
  rig.emulated.cause(Incident::kRestartStage);
  CHECK_THROWS_WITH(run_of_series(rig, first.homed, true),
                    Contains("has restarted since it was homed"));
  CHECK(homings_sent(rig) == 1);
}

TEST_CASE("a controller that restarts within a series without a lock stands at another count",
          "[rig][pty]") {
  EmulatedRigOptions options = homing_rig();
  options.grbl.is_unlocked_at_boot = true;
  RigFixture rig(options);
  const RunOutcome first = run_of_series(rig, std::nullopt, false);
  REQUIRE(first.homed);
  CHECK(std::abs(first.homed->stood_at_m) > 0.1e-3);  // else a restart would count the same
  const double stood_m = rig.emulated.outcome().final_position_m;
  const auto n_moves = rig.all<CommandedMove>().size();
  rig.emulated.cause(Incident::kRestartStage);
  CHECK_THROWS_WITH(run_of_series(rig, first.homed, true),
                    Contains("controller counts 0.000 mm") && Contains("end of the run before") &&
                        Contains("has restarted since it was homed") && Contains("--resume"));
  CHECK(homings_sent(rig) == 1);
  CHECK(rig.all<CommandedMove>().size() == n_moves);
  CHECK(rig.emulated.outcome().final_position_m == Approx(stood_m).margin(1e-9));
}

TEST_CASE("a stage that cannot be homed alone or stopped by its switch is refused before it moves",
          "[rig][pty]") {
  EmulatedRigOptions options = homing_rig();
  std::string expected;
  SECTION("soft limits would stop it at its count before the switch") {
    options.grbl.soft_limit_mm = 200.0;
    expected = "$20=1";
  }
  SECTION("all axes or none") {
    options.grbl.homes_all_axes = true;
    options.grbl.is_hal = GENERATE(false, true);
    expected = options.grbl.is_hal ? "Set bit 1 of $22" : "HOMING_SINGLE_AXIS_COMMANDS";
  }
  SECTION("no hard limits") {
    options.grbl.has_hard_limits = false;
    expected = "Set $21=1";
  }
  SECTION("no homing") {
    options.grbl.is_homing_enabled = false;
    expected = "Set $22=1";
  }
  SECTION("toward the specimen") {
    options.config.stage.toward_specimen = 1;
    expected = "homes toward the specimen";
  }
  RigFixture rig(options);
  CHECK_THROWS_WITH(rig.run(short_plan()), Contains(expected) && Contains("home = false"));
  CHECK(homings_sent(rig) == 0);
  CHECK(rig.emulated.outcome().final_position_m == 0.0);
}

TEST_CASE("the doubt names the side to which the count is wrong", "[rig]") {
  const double within_m = 1.6e-6;
  CHECK(lost_steps_doubt({1.5e-6, 4.8, within_m}).empty());
  CHECK_THAT(lost_steps_doubt({26e-6, 83.2, within_m}),
             Contains("while it pressed") && Contains("26.0 um (83 steps) further from"));
  CHECK_THAT(lost_steps_doubt({-26e-6, -83.2, within_m}),
             Contains("while it lifted") && Contains("26.0 um (83 steps) nearer to"));
}

}  // namespace
}  // namespace viscard
