#include "rig/emulator/pty_port.h"
#include "rig/lines/serial_line.h"
#include "rig/stages/marlin_stage.h"
#include "tests/rig/stages/stage_rig.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

namespace viscard {
namespace {

using Catch::Matchers::Contains;

constexpr double kStep_m = 1.0 / 3200e3;

EmulatedRigOptions marlin_rig() {
  return DeviceFixture::options("marlin");
}

std::vector<std::string> sent_lines(const DeviceFixture& rig, const std::string& word) {
  std::vector<std::string> found;
  for (const RawBytes& raw : rig.all<RawBytes>()) {
    if (raw.device != Device::kStage || !raw.is_sent) continue;
    if (raw.bytes.find(word) != std::string::npos) found.push_back(raw.bytes);
  }
  return found;
}

std::string error_of_marlin_on(const std::string& sent) {
  PtyPort device;
  const RigClock clock;
  SerialLine line(device.path(), 115200, clock);
  MarlinStage stage(line, StageConfig{}, clock, [](const RunRecord&) {});
  device.write(sent);
  try {
    stage.connect([&] {
      wait_readable({&line}, clock, 0.01);
      stage.service();
    });
  } catch (const RigError& error) {
    return error.what();
  }
  return "";
}

std::string error_of_move(DeviceFixture& rig, double to_m) {
  try {
    rig.move(to_m, 0.5e-3);
  } catch (const RigError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("a Marlin stage reports its dynamics and reaches its target at the speed asked for",
          "[rig][pty]") {
  EmulatedRigOptions options = marlin_rig();
  SECTION("as it comes") {}
  SECTION("native USB, whose start is missed") {
    options.marlin.talks_at_start = false;
  }
  SECTION("long answers") {
    options.marlin.sends_advanced_ok = true;
  }
  SECTION("lost answers") {
    options.marlin.lose_answer_every = 7;
  }
  SECTION("lost lines") {
    options.marlin.lose_line_every = 7;
  }
  SECTION("garbled lines, Resend alone") {
    options.marlin.garble_line_every = 5;
  }
  SECTION("garbled lines, Resend and ok") {
    options.marlin.garble_line_every = 5;
    options.marlin.sends_ok_after_resend = true;
  }
  SECTION("lost answers, Resend and ok") {
    options.marlin.lose_answer_every = 5;
    options.marlin.sends_ok_after_resend = true;
  }
  SECTION("late answers") {
    options.marlin.answer_delay_s = 0.4;
  }
  SECTION("mounted the other way round") {
    options.config.stage.toward_specimen = 1;
  }
  SECTION("another axis") {
    options.config.stage.axis = 'X';
  }
  DeviceFixture rig(options);
  rig.devices.stage->connect(rig.pump());
  CHECK(rig.devices.stage->identity() == "Marlin 2.1.2 (Feb  1 2023 12:00:00)");
  const StageDynamics dynamics = rig.devices.stage->dynamics();
  CHECK(dynamics.steps_per_m == Approx(3200e3).epsilon(1e-9));
  CHECK(dynamics.max_speed_m_s == Approx(10e-3).epsilon(1e-9));
  CHECK(dynamics.acceleration_m_s2 == Approx(0.2).epsilon(1e-9));
  CHECK(dynamics.min_speed_m_s == Approx(0.05e-3).epsilon(1e-9));
  REQUIRE(rig.move(0.5e-3, 0.25e-3));
  REQUIRE(rig.move(0.3e-3, 2e-3));
  CHECK(rig.emulated.outcome().final_position_m == Approx(0.3e-3).margin(1e-9));
  CHECK(rig.devices.stage->position_m() == Approx(0.3e-3).margin(1e-9));
  const auto moves = rig.all<CommandedMove>();
  REQUIRE(moves.size() == 2);
  CHECK(moves[0].move.to_m == Approx(0.5e-3).margin(1e-9));
  CHECK(moves[0].move.speed_m_s == Approx(0.25e-3).epsilon(1e-6));
  CHECK(moves[1].move.from_m == Approx(0.5e-3).margin(1e-9));
}

TEST_CASE("the pieces of a Marlin stage are short, and its speed is constant over them",
          "[rig][pty]") {
  DeviceFixture rig(marlin_rig());
  Stage& stage = *rig.devices.stage;
  stage.connect(rig.pump());
  const double speed_m_s = GENERATE(0.05e-3, 0.2e-3, 1e-3);
  const std::size_t n_before = sent_lines(rig, "G1 Z").size();
  stage.begin_move(0.6e-3, speed_m_s, "ramp");
  while (stage.is_moving()) rig.pump()();
  CHECK(rig.all<CommandedMove>().back().start_uncertainty_s < 0.12);
  for (const RunEvent& event : rig.all<RunEvent>()) CHECK(event.name != "move_doubtful");
  const double piece_m = std::max(20e-6, 0.05 * speed_m_s);
  CHECK(sent_lines(rig, "G1 Z").size() - n_before ==
        static_cast<std::size_t>(std::ceil(0.6e-3 / piece_m - 1e-9)));
}

TEST_CASE("a Marlin stage that hears nothing more comes to rest within three pieces",
          "[rig][pty]") {
  DeviceFixture rig(marlin_rig());
  Stage& stage = *rig.devices.stage;
  stage.connect(rig.pump());
  stage.begin_move(2e-3, 0.2e-3, "approach");
  rig.pump_for(1.0);
  const double before_m = rig.emulated.outcome().final_position_m;
  CHECK(before_m > 0.1e-3);
  CHECK(stage.position_m() <= before_m + kStep_m);
  CHECK(stage.position_m() > before_m - 0.2e-3 * 0.12);                // 10 reports a second
  for (int i = 0; i < 1000; ++i) wait_readable({}, rig.clock, 0.002);  // the program is frozen
  CHECK_FALSE(rig.emulated.outcome().is_moving);
  CHECK(rig.emulated.outcome().final_position_m <= before_m + 61e-6);
}

TEST_CASE("a Marlin stage whose port is lost stands within three pieces of its last report",
          "[rig][pty]") {
  EmulatedRigOptions options = marlin_rig();
  options.truth.surface_position_m = 1e-3;
  options.fault = rig_fault_from_text("stage-port@approach");
  DeviceFixture rig(options);
  Stage& stage = *rig.devices.stage;
  stage.connect(rig.pump());
  stage.begin_move(5e-3, 0.25e-3, "approach");
  pump_into_move(rig, 0.2);
  rig.emulated.enter_phase("approach");
  CHECK_THROWS_AS(rig.pump_for(2.0), PortHungUp);
  const double reported_m = rig.all<StageReport>().back().position_m;
  CHECK(reported_m < 0.9e-3);
  for (int i = 0; i < 20; ++i) rig.clock.pass(0.1);
  CHECK_FALSE(rig.emulated.outcome().is_moving);
  // A report is at most 0.12 s old.
  CHECK(rig.emulated.outcome().final_position_m <= reported_m + 61e-6 + 0.12 * 0.25e-3);
  CHECK(rig.emulated.outcome().peak_force_N < 1e-6);
}

TEST_CASE("a Marlin stage stops gently or at once and can be moved again", "[rig][pty]") {
  EmulatedRigOptions options = marlin_rig();
  SECTION("with an emergency parser") {}
  SECTION("without one, late") {
    options.marlin.has_emergency_parser = false;
    options.marlin.stop_delay_s = 0.1;
  }
  // The first stop is that of connect(), the second the gentle one, the third the hard one.
  SECTION("the gentle one is lost") {
    options.marlin.lose_stop_number = 2;
  }
  SECTION("the hard one is lost") {
    options.marlin.lose_stop_number = 3;
  }
  SECTION("answers are late") {
    options.marlin.answer_delay_s = 0.2;
  }
  DeviceFixture rig(options);
  Stage& stage = *rig.devices.stage;
  stage.connect(rig.pump());
  stage.begin_move(2e-3, 1e-3, "approach");
  rig.pump_for(0.5);
  stage.stop_soft();
  while (stage.is_moving()) rig.pump()();
  const double stopped_m = stage.position_m();
  CHECK(stopped_m > 0.02e-3);
  CHECK(stopped_m < 1.2e-3);
  CHECK_FALSE(rig.emulated.outcome().is_moving);
  CHECK(rig.emulated.outcome().final_position_m == Approx(stopped_m).margin(1e-9));
  REQUIRE_FALSE(rig.all<CommandedMove>().empty());
  CHECK(rig.all<CommandedMove>().back().move.to_m == Approx(stopped_m).margin(1e-12));
  stage.begin_move(3e-3, 1e-3, "approach");
  rig.pump_for(0.3);
  stage.stop_hard();
  stage.recover(rig.pump());
  CHECK_FALSE(stage.is_moving());
  CHECK(rig.emulated.outcome().final_position_m == Approx(stage.position_m()).margin(1e-9));
  CHECK(stage.position_m() < 2.5e-3);
  REQUIRE(rig.move(0.0, 2e-3));
  CHECK(rig.emulated.outcome().final_position_m == Approx(0.0).margin(1e-9));
}

TEST_CASE("a stop of a Marlin stage is written once while the board does not answer",
          "[rig][pty]") {
  EmulatedRigOptions options = marlin_rig();
  options.marlin.has_emergency_parser = GENERATE(true, false);
  DeviceFixture rig(options);
  Stage& stage = *rig.devices.stage;
  stage.connect(rig.pump());
  CHECK(sent_lines(rig, "M410").size() == 1);
  stage.begin_move(2e-3, 1e-3, "approach");
  rig.pump_for(0.55);
  const double written_s = rig.clock.now_s();
  stage.stop_soft();
  stage.stop_hard();  // in the time of the first
  const std::size_t n_before = sent_lines(rig, "M410").size();
  CHECK(n_before == 2);
  while (stage.is_moving()) rig.pump()();
  CHECK(rig.clock.now_s() - written_s > (options.marlin.has_emergency_parser ? 0.99 : 1.99));
  // A piece that was open is overtaken by the stop, which then follows once more.
  CHECK(sent_lines(rig, "M410").size() <= n_before + 1);
  CHECK(rig.emulated.outcome().final_position_m == Approx(stage.position_m()).margin(1e-9));
}

TEST_CASE("a piece that a stop of a Marlin stage overtakes is not made", "[rig][pty]") {
  EmulatedRigOptions options = marlin_rig();
  options.marlin.has_emergency_parser = GENERATE(true, false);
  DeviceFixture rig(options);
  Stage& stage = *rig.devices.stage;
  stage.connect(rig.pump());
  rig.pump_for(0.01);
  const std::size_t n_before = sent_lines(rig, "G1 Z").size();
  stage.begin_move(2e-3, 0.2e-3, "approach");
  CHECK(sent_lines(rig, "G1 Z").size() == n_before + 1);
  stage.stop_soft();
  while (stage.is_moving()) rig.pump()();
  rig.pump_for(0.5);
  CHECK(rig.emulated.outcome().final_position_m == Approx(stage.position_m()).margin(1e-9));
  CHECK(stage.position_m() < 5e-6);
}

TEST_CASE("answers to a stop that was written again are not taken for those of later lines",
          "[rig][pty]") {
  EmulatedRigOptions options = marlin_rig();
  options.marlin.has_emergency_parser = GENERATE(true, false);
  // It answers 2.7 or 2.8 s after a stop: so late that the stop is written again.
  options.marlin.stopped_s = options.marlin.has_emergency_parser ? 2.7 : 1.4;
  DeviceFixture rig(options);
  Stage& stage = *rig.devices.stage;
  stage.connect(rig.pump());
  CHECK(sent_lines(rig, "M410").size() >= 2);
  stage.begin_move(2e-3, 0.2e-3, "approach");
  rig.pump_for(1.0);
  stage.stop_soft();
  while (stage.is_moving()) rig.pump()();
  CHECK(rig.emulated.outcome().final_position_m == Approx(stage.position_m()).margin(1e-9));
  REQUIRE(rig.move(0.0, 1e-3));
  REQUIRE(rig.move(0.3e-3, 0.2e-3));
  CHECK(rig.emulated.outcome().final_position_m == Approx(0.3e-3).margin(1e-9));
  for (const RunEvent& event : rig.all<RunEvent>()) {
    CHECK(event.name != "stage_unexpected_answer");
    CHECK(event.name != "move_doubtful");
  }
}

TEST_CASE("a Marlin board that reports its plan is refused before it presses", "[rig][pty]") {
  EmulatedRigOptions options = marlin_rig();
  options.marlin.has_emergency_parser = GENERATE(true, false);
  options.config.stage.toward_specimen = GENERATE(-1, 1);
  std::string reason;
  SECTION("a build without M114_REALTIME") {
    options.marlin.has_realtime_reports = false;
    reason = "where its moves will end";
  }
  SECTION("the same, with late answers") {
    options.marlin.has_realtime_reports = false;
    options.marlin.answer_delay_s = 0.2;
    reason = "where its moves will end";
  }
  SECTION("one whose M114 waits for the end of moves") {
    options.marlin.waits_in_m114 = true;
    reason = "M114_LEGACY";
  }
  DeviceFixture rig(options);
  CHECK_THROWS_WITH(rig.run(shortest_stage_plan()), Contains(reason) && Contains("M114_REALTIME"));
  CHECK(rig.emulated.outcome().peak_force_N < 1e-6);
  CHECK(rig.emulated.outcome().final_position_m <= 1e-9);
}

TEST_CASE("what a Marlin board reports is found out by a short move away and back", "[rig][pty]") {
  EmulatedRigOptions options = marlin_rig();
  double farthest_m = 20e-6;
  bool is_check = false;
  SECTION("away") {}
  SECTION("by no more than 0.3 mm") {
    options.marlin.answer_delay_s = 0.25;
    farthest_m = 0.3e-3;
  }
  SECTION("not by a check, which moves nothing") {
    is_check = true;
  }
  DeviceFixture rig(options);
  if (is_check) rig.devices.stage->keep_locked();
  rig.devices.stage->connect(rig.pump());
  CHECK(sent_lines(rig, "G1 ").empty() == is_check);
  for (const StageReport& report : rig.all<StageReport>()) {
    CHECK(report.position_m >= -farthest_m - 1e-9);
    CHECK(report.position_m <= 1e-9);
  }
  CHECK(rig.emulated.outcome().final_position_m == Approx(0.0).margin(1e-9));
  CHECK(rig.move(0.2e-3, 0.5e-3));
}

TEST_CASE("a Marlin stage that cannot move away from the specimen does not move toward it",
          "[rig][pty]") {
  EmulatedRigOptions options = marlin_rig();
  options.config.stage.toward_specimen = GENERATE(-1, 1);
  options.marlin.has_realtime_reports = GENERATE(true, false);
  options.marlin.lowest_m = 0.0;
  SECTION("at the end of its travel") {}
  SECTION("near it") {
    options.marlin.lowest_m = -2e-6;
  }
  DeviceFixture rig(options);
  CHECK_THROWS_WITH(rig.devices.stage->connect(rig.pump()),
                    Contains("does not move away from the specimen") && Contains("M211"));
  rig.pump_for(1.0);
  for (const StageReport& report : rig.all<StageReport>()) CHECK(report.position_m <= 1e-9);
  CHECK(rig.emulated.outcome().final_position_m <= 1e-9);
}

TEST_CASE("a Marlin stage outside of its soft limits is stopped on its way to them", "[rig][pty]") {
  EmulatedRigOptions options = marlin_rig();
  options.marlin.has_realtime_reports = GENERATE(true, false);
  options.marlin.lowest_m = 0.5e-3;
  DeviceFixture rig(options);
  CHECK_THROWS_WITH(rig.devices.stage->connect(rig.pump()), Contains("outside of its path"));
  for (int i = 0; i < 20; ++i) rig.clock.pass(0.1);
  CHECK_FALSE(rig.emulated.outcome().is_moving);
  CHECK(rig.emulated.outcome().final_position_m < 30e-6);
}

TEST_CASE("an interrupted proof of what a Marlin board reports leaves its stage at rest",
          "[rig][pty]") {
  DeviceFixture rig(marlin_rig());
  const Pump pump = [&] {
    rig.pump()();
    if (rig.emulated.outcome().is_moving) throw RunInterrupted("interrupted");
  };
  CHECK_THROWS_AS(rig.devices.stage->connect(pump), RunInterrupted);
  for (int i = 0; i < 5; ++i) rig.clock.pass(0.1);
  CHECK_FALSE(rig.emulated.outcome().is_moving);
  CHECK(rig.emulated.outcome().final_position_m <= 1e-9);
  CHECK(rig.emulated.outcome().final_position_m > -10e-6);
  CHECK(sent_lines(rig, "G1 ").size() == 1);
}

TEST_CASE("a Marlin board that reports its plan lifts the punch", "[rig][pty]") {
  EmulatedRigOptions options = marlin_rig();
  options.marlin.has_realtime_reports = false;
  DeviceFixture rig(options);
  rig.devices.stage->plan_lift_only();
  rig.devices.stage->connect(rig.pump());
  REQUIRE(rig.move(-0.2e-3, 0.5e-3));
  CHECK_FALSE(rig.emulated.outcome().is_moving);
  CHECK(rig.emulated.outcome().final_position_m == Approx(-0.2e-3).margin(1e-9));
}

TEST_CASE("a clipped move of a Marlin stage is noticed", "[rig][pty]") {
  EmulatedRigOptions options = marlin_rig();
  options.marlin.highest_m = 0.4e-3;
  options.marlin.lowest_m = -0.1e-3;
  DeviceFixture rig(options);
  Stage& stage = *rig.devices.stage;
  stage.connect(rig.pump());
  REQUIRE(rig.move(-0.5e-3, 1e-3));  // a lift ends at the end of the travel
  CHECK(stage.position_m() == Approx(-0.1e-3).margin(1e-9));
  CHECK_THAT(error_of_move(rig, 0.8e-3), Contains("did not reach 0.8000 mm") && Contains("M211"));
}

TEST_CASE("a Marlin stage that makes no move before homing says what the board said",
          "[rig][pty]") {
  EmulatedRigOptions options = marlin_rig();
  options.marlin.needs_home = true;
  SECTION("not homed") {
    DeviceFixture rig(options);
    CHECK_THROWS_WITH(rig.devices.stage->connect(rig.pump()), Contains("Home XYZ first"));
  }
  SECTION("homed") {
    options.config.stage.home = true;
    options.marlin.homing_s = 20.0;
    DeviceFixture rig(options);
    rig.devices.stage->connect(rig.pump());
    CHECK(rig.move(0.2e-3, 1e-3));
  }
}

TEST_CASE("a Marlin stage that homing leaves at the end of its travel is proven from there",
          "[rig][pty]") {
  EmulatedRigOptions options = marlin_rig();
  options.config.stage.home = true;
  options.marlin.homing_s = 2.0;
  options.marlin.lowest_m = 0.0;
  DeviceFixture rig(options);
  rig.devices.stage->connect(rig.pump());
  for (const StageReport& report : rig.all<StageReport>()) {
    CHECK(report.position_m <= 0.1e-3 + 1e-9);
  }
  // Away from the end, so that the next connection has a way.
  CHECK(rig.emulated.outcome().final_position_m == Approx(0.1e-3).margin(1e-9));
  CHECK(rig.move(0.2e-3, 1e-3));
}

TEST_CASE("a Marlin board that restarts while it homes is not homed again", "[rig][pty]") {
  EmulatedRigOptions options = marlin_rig();
  options.config.stage.home = true;
  options.marlin.homing_s = 2.0;
  options.marlin.restarts_in_homing = true;
  DeviceFixture rig(options);
  const double begun_s = rig.clock.now_s();
  CHECK_THROWS_WITH(rig.devices.stage->connect(rig.pump()), Contains("restarted while it homed"));
  CHECK(rig.clock.now_s() < begun_s + 30.0);
  CHECK(sent_lines(rig, "G28").size() == 1);
}

TEST_CASE("a Marlin board that halts raises an alarm and asks for a person", "[rig][pty]") {
  EmulatedRigOptions options = marlin_rig();
  options.marlin.halt_number = 100;
  DeviceFixture rig(options);
  Stage& stage = *rig.devices.stage;
  stage.connect(rig.pump());
  stage.begin_move(2e-3, 0.2e-3, "approach");
  CHECK_THROWS_WITH(rig.pump_for(10.0), Contains("Printer halted"));
  CHECK_THROWS_WITH(stage.recover(rig.pump()), Contains("by hand"));
}

TEST_CASE("moves of fewer than six steps are recorded as they were made", "[rig][pty]") {
  EmulatedRigOptions options = marlin_rig();
  options.marlin.makes_short_moves = GENERATE(true, false);
  DeviceFixture rig(options);
  Stage& stage = *rig.devices.stage;
  stage.connect(rig.pump());
  REQUIRE(rig.move(3.0 * kStep_m, 0.1e-3));
  const double made_m = options.marlin.makes_short_moves ? 3.0 * kStep_m : 0.0;
  CHECK(stage.position_m() == Approx(made_m).margin(1e-12));
  REQUIRE(rig.move(20.0 * kStep_m, 0.1e-3));
  CHECK(rig.emulated.outcome().final_position_m == Approx(20.0 * kStep_m).margin(1e-12));
}

TEST_CASE("a stage that is too coarse, or not Marlin, is refused", "[rig][pty]") {
  EmulatedRigOptions options = marlin_rig();
  SECTION("coarse") {
    options.truth.steps_per_m = 100e3;
    DeviceFixture rig(options);
    CHECK_THROWS_WITH(rig.devices.stage->connect(rig.pump()), Contains("too coarse"));
  }
  SECTION("another firmware") {
    options.marlin.firmware = "Repetier_1.0.3";
    DeviceFixture rig(options);
    CHECK_THROWS_WITH(rig.devices.stage->connect(rig.pump()), Contains("Repetier_1.0.3"));
  }
}

TEST_CASE("what answers instead of Marlin is quoted", "[rig][pty]") {
  CHECK_THAT(error_of_marlin_on("8388607\r\n8388610\r\n"),
             Contains("It sent '8388607'") && Contains("swapped"));
  CHECK_THAT(error_of_marlin_on(std::string(40, '\xf8')), Contains("250000"));
}

TEST_CASE("a whole test runs on a Marlin stage with and without an emergency parser",
          "[rig][pty]") {
  EmulatedRigOptions options = marlin_rig();
  options.marlin.has_emergency_parser = GENERATE(true, false);
  DeviceFixture rig(options);
  const RunOutcome outcome = rig.run(shortest_stage_plan());
  INFO(outcome.reason);
  REQUIRE(outcome.status == "finished");
  CHECK(outcome.achieved_depth_m == Approx(0.13e-3).margin(4e-6));
  CHECK(rig.emulated.outcome().final_position_m < demo_truth(10.0, 7).surface_position_m);
}

}  // namespace viscard
