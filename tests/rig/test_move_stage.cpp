#include "rig/move_stage.h"
#include "tests/rig/rig_fixture.h"

#include <catch2/catch.hpp>

#include <functional>
#include <variant>

namespace viscard {
namespace {

using Catch::Matchers::Contains;

StageMoved moved_on(RigFixture& rig, const StageOrder& order) {
  RunControl control;
  control.clock = &rig.clock;
  control.stop = &rig.stop;
  return move_stage(rig.stage, rig.load_cell, rig.config, rig.sink, control, order);
}

StageOrder jog(double toward_m, double limit_N = 0.1) {
  StageOrder order;
  order.toward_m = toward_m;
  order.limit_N = limit_N;
  return order;
}

}  // namespace

TEST_CASE("a jog moves the stage by its way in either direction", "[rig][pty]") {
  const double way_m = GENERATE(-0.3e-3, 0.04e-3);
  EmulatedRigOptions options = RigFixture::options();
  options.truth.surface_position_m = 0.5e-3;
  RigFixture rig(options);
  const StageMoved moved = moved_on(rig, jog(way_m));
  CHECK_FALSE(moved.is_stopped_by_force);
  // Toward the specimen no force may also mean a blind cell.
  CHECK(Contains("no force was felt").match(moved.note) == (way_m > 0.0));
  CHECK(moved.to_m - moved.from_m == Approx(way_m).margin(1e-6));
  CHECK(rig.emulated.outcome().final_position_m == Approx(way_m).margin(1e-6));
}

TEST_CASE("a jog into the specimen ends at its limit of force", "[rig][pty]") {
  EmulatedRigOptions options = RigFixture::options();
  options.truth.surface_position_m = 0.1e-3;
  RigFixture rig(options);
  const StageMoved moved = moved_on(rig, jog(1e-3, 0.05));
  CHECK(moved.is_stopped_by_force);
  CHECK(moved.to_m < 0.2e-3);
  // One jog of 25 um at 8.8 N/mm beyond the limit at most.
  CHECK(rig.emulated.outcome().peak_force_N < 0.05 + 8.8e3 * 25e-6);
}

TEST_CASE("a lift of a punch that presses goes on while the force falls, until it is free",
          "[rig][pty]") {
  EmulatedRigOptions options = RigFixture::options();
  options.truth.surface_position_m = -0.06e-3;
  RigFixture rig(options);
  const StageMoved moved = moved_on(rig, jog(-1e-3, 0.1));
  CHECK(moved.force_before_N > 0.25);
  CHECK_FALSE(moved.is_stopped_by_force);
  CHECK(moved.to_m - moved.from_m == Approx(-1e-3).margin(1e-6));
  CHECK(moved.force_after_N == Approx(0.0).margin(0.03));
}

TEST_CASE("a lift ends when the force rises, or when it pulls", "[rig][pty]") {
  const double change_N = GENERATE(0.15, -0.3);
  RigFixture rig(RigFixture::options());
  rig.on_record = [&](const RunRecord& record) {
    const auto* report = std::get_if<StageReport>(&record);
    if (report != nullptr && report->position_m < -0.2e-3) rig.emulated.hang_weight(change_N);
  };
  const StageMoved moved = moved_on(rig, jog(-1e-3, 0.1));
  CHECK(moved.is_stopped_by_force);
  CHECK(moved.to_m > -0.5e-3);
}

TEST_CASE("a lift of a punch that is pulled goes on while the pull ends", "[rig][pty]") {
  RigFixture rig(RigFixture::options());
  rig.emulated.hang_weight(-0.3);
  rig.on_record = [&](const RunRecord& record) {
    const auto* report = std::get_if<StageReport>(&record);
    if (report != nullptr && report->position_m < -0.2e-3) rig.emulated.hang_weight(0.0);
  };
  const StageMoved moved = moved_on(rig, jog(-1e-3, 0.1));
  CHECK_FALSE(moved.is_stopped_by_force);
  CHECK(moved.to_m - moved.from_m == Approx(-1e-3).margin(1e-6));
}

TEST_CASE("a punch that presses above the limit of force is lifted, and not pressed further",
          "[rig][pty]") {
  EmulatedRigOptions options = RigFixture::options();
  options.truth.surface_position_m = -0.06e-3;
  options.config.safety.soft_fraction = 0.1;
  RigFixture rig(options);
  CHECK_THROWS_WITH(moved_on(rig, jog(0.1e-3)), Contains("already pressing"));
  CHECK(rig.emulated.outcome().final_position_m == 0.0);
  CHECK_THROWS_WITH(moved_on(rig, jog(-1e-3)),
                    Contains("above the limit of") && Contains("The stage was lifted to -1.0000"));
  CHECK(rig.emulated.outcome().final_position_m == Approx(-1e-3).margin(1e-6));
}

// A punch that presses above the limit of force.
EmulatedRigOptions pressing_above_limit() {
  EmulatedRigOptions options = RigFixture::options();
  options.truth.surface_position_m = -0.06e-3;
  options.config.safety.soft_fraction = 0.1;
  return options;
}

TEST_CASE("a lift from a force above the limit that goes toward the specimen is stopped",
          "[rig][pty]") {
  RigFixture rig(pressing_above_limit());
  StageConfig turned = rig.config.stage;
  turned.toward_specimen = -turned.toward_specimen;
  GrblStage stage(rig.stage_line, turned, rig.clock, rig.sink);
  RunControl control;
  control.clock = &rig.clock;
  CHECK_THROWS_WITH(move_stage(stage, rig.load_cell, rig.config, rig.sink, control, jog(-1e-3)),
                    Contains("the stage moves toward the specimen") &&
                        Contains("THE PUNCH MAY PRESS") && !Contains("lifted to"));
  for (const double until_s = rig.clock.now_s() + 1.0; rig.clock.now_s() < until_s;) {
    wait_readable({&rig.stage_line}, rig.clock, 0.002);
    rig.stage_line.read_available();
  }
  CHECK_FALSE(rig.emulated.outcome().is_moving);
  CHECK(rig.emulated.outcome().final_position_m < 0.05e-3);
}

TEST_CASE("a pull above the limit of force moves nothing", "[rig][pty]") {
  EmulatedRigOptions options = RigFixture::options();
  options.config.safety.soft_fraction = 0.1;
  RigFixture rig(options);
  rig.emulated.hang_weight(-0.2 * options.config.calibration.capacity_N);
  CHECK_THROWS_WITH(moved_on(rig, jog(-1e-3)), Contains("above the limit of"));
  CHECK(rig.emulated.outcome().final_position_m == 0.0);
}

TEST_CASE("a lift from a force above the limit ends when a person stops it, or without readings",
          "[rig][pty]") {
  const bool is_stopped = GENERATE(true, false);
  RigFixture rig(pressing_above_limit());
  rig.on_record = [&](const RunRecord& record) {
    const auto* report = std::get_if<StageReport>(&record);
    if (report == nullptr || report->position_m > -0.1e-3) return;
    if (is_stopped) rig.stop = true;
    if (!is_stopped) rig.emulated.cause(Incident::kSilenceLoadCell);
  };
  CHECK_THROWS_WITH(moved_on(rig, jog(-1e-3)),
                    Contains(is_stopped ? "the lift was stopped" : "NO NEW FORCE"));
  CHECK(rig.emulated.outcome().final_position_m > -0.6e-3);
}

TEST_CASE("a lift from a force above the limit that is frozen ends at once", "[rig][pty]") {
  EmulatedRigOptions options = pressing_above_limit();
  options.fault = rig_fault_from_text("frozen");
  RigFixture rig(options);
  CHECK_THROWS_AS(moved_on(rig, jog(-1e-3)), RigError);
  CHECK(rig.emulated.outcome().final_position_m > -0.2e-3);
}

TEST_CASE("a stage does not move with a load cell that does not measure", "[rig][pty]") {
  const double way_m = GENERATE(0.1e-3, -0.1e-3);
  EmulatedRigOptions options = RigFixture::options();
  options.fault = rig_fault_from_text(GENERATE("frozen", "zeros", "open-wire"));
  RigFixture rig(options);
  CHECK_THROWS_AS(moved_on(rig, jog(way_m)), RigError);
  CHECK(rig.emulated.outcome().final_position_m == 0.0);
}

TEST_CASE("a homing by hand that fails is an error", "[rig][pty]") {
  EmulatedRigOptions options = RigFixture::options();
  options.grbl.is_homing_enabled = true;
  options.grbl.fail_homing_number = 1;
  options.config.stage.home = true;  // move_stage() is given a driver with the home of its order
  RigFixture rig(options);
  StageOrder order;
  order.is_home = true;
  CHECK_THROWS_WITH(moved_on(rig, order), Contains("alarm 8") && Contains("not homed"));
}

TEST_CASE("a move that unlocks a stage which is not homed warns, because no later command can",
          "[rig][pty]") {
  EmulatedRigOptions options = RigFixture::options();
  options.grbl.is_homing_enabled = true;
  options.grbl.is_homed = GENERATE(false, true);
  RigFixture rig(options);
  const StageMoved moved = moved_on(rig, jog(-0.1e-3));
  if (options.grbl.is_homed) {
    CHECK(moved.note.empty());
  } else {
    CHECK_THAT(moved.note, Contains("unlocked without homing") && Contains("viscard rig home"));
  }
}

TEST_CASE("a refused move that has unlocked a stage which is not homed warns, too", "[rig][pty]") {
  EmulatedRigOptions options = RigFixture::options();
  options.grbl.is_homing_enabled = true;
  RigFixture rig(options);
  SECTION("by a force that presses already") {
    rig.emulated.hang_weight(0.3);
    CHECK_THROWS_WITH(
        moved_on(rig, jog(0.1e-3)),
        Contains("Take away") && Contains("; the stage was locked and has been unlocked"));
  }
  SECTION("by a person") {
    rig.on_record = [&](const RunRecord& record) {
      const auto* event = std::get_if<RunEvent>(&record);
      if (event != nullptr && event->name == "phase") rig.stop = true;
    };
    CHECK_THROWS_WITH(moved_on(rig, jog(0.1e-3)),
                      Contains("stopped before it began; the stage was locked"));
  }
  CHECK(rig.emulated.outcome().final_position_m == 0.0);
}

TEST_CASE("a homing that a person or a force ends is no move that has not begun", "[rig][pty]") {
  EmulatedRigOptions options = RigFixture::options();
  options.grbl.is_homing_enabled = true;
  options.config.stage.home = true;
  RigFixture rig(options);
  StageOrder home;
  home.is_home = true;
  const auto in_homing = [&](const std::function<void()>& happens) {
    rig.on_record = [happens](const RunRecord& record) {
      const auto* raw = std::get_if<RawBytes>(&record);
      if (raw != nullptr && raw->is_sent && raw->bytes.rfind("$H", 0) == 0) happens();
    };
  };
  SECTION("a person") {
    in_homing([&] { rig.stop = true; });
    CHECK_THROWS_WITH(moved_on(rig, home),
                      Contains("the homing was stopped") && Contains("Look at the punch"));
  }
  SECTION("a force") {
    in_homing([&] { rig.emulated.hang_weight(2.2); });
    CHECK_THROWS_WITH(moved_on(rig, home), Contains("connected and homed: IT MAY STILL PRESS") &&
                                               !Contains("before anything was moved"));
  }
}

}  // namespace viscard
