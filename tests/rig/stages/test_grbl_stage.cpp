#include "tests/rig/rig_fixture.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <string>
#include <variant>

namespace viscard {
namespace {

using Catch::Matchers::Contains;

bool is_line_sent(const RunRecord& record, const std::string& line) {
  const auto* raw = std::get_if<RawBytes>(&record);
  return raw != nullptr && raw->is_sent && raw->bytes == line + "\n";
}

long n_lines_sent(const RigFixture& rig, const std::string& line) {
  return std::count_if(rig.records.begin(), rig.records.end(),
                       [&](const RunRecord& record) { return is_line_sent(record, line); });
}

}  // namespace

TEST_CASE("a stage is identified, its settings are read, and its moves end exactly", "[rig][pty]") {
  EmulatedRigOptions options = RigFixture::options();
  options.grbl.is_hal = GENERATE(false, true);
  RigFixture rig(options);
  rig.stage.connect(rig.pump());
  CHECK(rig.stage.identity() == (options.grbl.is_hal ? "grblHAL 1.1f" : "Grbl 1.1h"));
  CHECK(rig.stage.dynamics().steps_per_m == Approx(3200e3).epsilon(1e-12));
  CHECK(rig.stage.dynamics().acceleration_m_s2 == Approx(0.2).epsilon(1e-12));
  CHECK(rig.stage.dynamics().max_speed_m_s == Approx(10e-3).epsilon(1e-9));
  move_and_wait(rig, 0.5e-3, 1e-3);
  move_and_wait(rig, 0.25e-3 + 0.1e-6, 1e-3);
  CHECK(rig.stage.position_m() == Approx(0.25e-3).margin(0.5 / 3200e3));
  CHECK(rig.emulated.outcome().final_position_m == Approx(rig.stage.position_m()).margin(1e-12));
  const auto moves = rig.all<CommandedMove>();
  REQUIRE(moves.size() == 2);
  CHECK(moves[1].move.from_m == moves[0].move.to_m);
  CHECK(moves[1].start_uncertainty_s >= 0.0);
}

TEST_CASE("everything before the welcome is dropped, even errors", "[rig][pty]") {
  EmulatedRigOptions options = RigFixture::options();
  options.grbl.has_empty_eeprom = true;
  RigFixture rig(options);
  rig.stage.connect(rig.pump());
  CHECK(rig.stage.state() == "Idle");
}

TEST_CASE("a controller that does not reset on opening is reset by the driver", "[rig][pty]") {
  EmulatedRigOptions options = RigFixture::options();
  options.resets_on_open = false;
  EmulatedRig emulated(options);
  const RigClock clock = emulated.clock();
  const RecordSink sink = [](const RunRecord&) {};
  const Pump sleep = [&] { wait_readable({}, clock, 0.002); };
  for (int i = 0; i < 2; ++i) {  // at the second opening it runs already and sends no welcome
    SerialLine line(emulated.stage_port(), 115200, clock);
    GrblStage stage(line, options.config.stage, clock, sink, 0.2);
    stage.connect([&] {
      sleep();
      stage.service();
    });
    CHECK(stage.state() == "Idle");
  }
}

TEST_CASE("lost reports, late answers and doubled answers do not disturb a move", "[rig][pty]") {
  EmulatedRigOptions options = RigFixture::options();
  SECTION("every second '?' unanswered") {
    options.grbl.lose_status_every = 2;
  }
  SECTION("ok 300 ms late") {
    options.grbl.ok_delay_s = 0.3;
  }
  SECTION("every ok twice") {
    options.grbl.answers_twice = true;
  }
  SECTION("work positions") {
    options.grbl.reports_work_position = true;
  }
  RigFixture rig(options);
  rig.stage.connect(rig.pump());
  move_and_wait(rig, 0.2e-3, 0.5e-3);
  move_and_wait(rig, 0.1e-3, 0.5e-3);
  CHECK(rig.stage.position_m() == Approx(0.1e-3).epsilon(1e-9));
  CHECK_FALSE(rig.emulated.outcome().is_moving);
}

TEST_CASE("a stage that boots locked is homed if the rig file asks for it and unlocked otherwise",
          "[rig][pty]") {
  EmulatedRigOptions options = RigFixture::options();
  options.grbl.is_homing_enabled = true;
  options.config.stage.home = GENERATE(false, true);
  RigFixture rig(options);
  rig.stage.connect(rig.pump());
  CHECK(rig.stage.state() == "Idle");
  CHECK(rig.has_event("stage_unlocked", "") == !options.config.stage.home);
  if (options.config.stage.home) {
    // machine zero is the switch, 3 mm away from the specimen; pulled off by 1 mm
    CHECK(rig.stage.position_m() == Approx(1e-3).margin(1e-6));
  }
}

TEST_CASE("a homing cycle that fails is an error, is not tried again and leaves the stage locked",
          "[rig][pty]") {
  EmulatedRigOptions options = RigFixture::options();
  options.grbl.is_homing_enabled = true;
  options.grbl.is_hal = GENERATE(false, true);
  options.config.stage.home = true;
  std::string expected;
  bool restarts = false;
  SECTION("it stays on its switch") {
    options.grbl.fail_homing_number = 1;
    expected = "alarm 8: homing could not clear the limit switch";
  }
  SECTION("it finds no switch") {
    options.grbl.fail_homing_number = 1;
    options.grbl.homing_alarm = 9;
    expected = "alarm 9: homing found no limit switch";
  }
  SECTION("the controller restarts") {
    restarts = true;
    expected = "a restart of its controller";
  }
  RigFixture rig(options);
  rig.on_record = [&](const RunRecord& record) {
    if (restarts && is_line_sent(record, "$H")) rig.emulated.cause(Incident::kRestartStage);
  };
  CHECK_THROWS_WITH(rig.stage.connect(rig.pump()), Contains(expected) && Contains("not homed"));
  pump_for(rig, 1.0);  // the welcome
  CHECK_FALSE(rig.stage.homed_at_m());
  CHECK_FALSE(rig.stage.trouble_with_zero().empty());
  CHECK(n_lines_sent(rig, "$H") == 1);
  CHECK(n_lines_sent(rig, "$X") == 0);
  CHECK_FALSE(rig.has_event("stage_unlocked", ""));
}

TEST_CASE("a gentle stop ends short of the target, and the record has the position", "[rig][pty]") {
  RigFixture rig(RigFixture::options());
  rig.stage.connect(rig.pump());
  rig.stage.begin_move(1e-3, 0.5e-3, "test");
  const Pump pump = rig.pump();
  pump_for(rig, 0.3);
  rig.stage.stop_soft();
  while (rig.stage.is_moving()) pump();
  const double here_m = rig.emulated.outcome().final_position_m;
  CHECK(here_m > 0.1e-3);
  CHECK(here_m < 0.9e-3);
  CHECK(rig.stage.position_m() == Approx(here_m).margin(0.6e-6));  // three decimals of a mm
  REQUIRE(rig.all<CommandedMove>().size() == 1);
  CHECK(rig.all<CommandedMove>()[0].move.to_m == rig.stage.position_m());
}

TEST_CASE("a reset in motion stops at once, and the stage works again after recovery",
          "[rig][pty]") {
  RigFixture rig(RigFixture::options());
  rig.stage.connect(rig.pump());
  rig.stage.begin_move(1e-3, 0.5e-3, "test");
  const Pump pump = rig.pump();
  pump_for(rig, 0.2);
  rig.stage.stop_hard();
  rig.stage.recover(pump);
  CHECK(rig.has_event("stage_alarm", "3"));
  CHECK(rig.stage.state() == "Idle");
  const double here_m = rig.stage.position_m();
  CHECK(here_m < 0.9e-3);
  move_and_wait(rig, here_m - 0.05e-3, 0.5e-3);
  CHECK(rig.emulated.outcome().final_position_m == Approx(here_m - 0.05e-3).margin(0.6e-6));
}

TEST_CASE("a reset of a homed stage at rest does not count as an unlocking", "[rig][pty]") {
  EmulatedRigOptions options = RigFixture::options();
  options.grbl.is_homing_enabled = true;
  options.grbl.is_homed = true;
  RigFixture rig(options);
  rig.stage.connect(rig.pump());
  move_and_wait(rig, rig.stage.position_m() - 0.1e-3, 0.5e-3);
  const double stood_m = rig.stage.position_m();
  rig.stage.stop_hard();
  rig.stage.recover(rig.pump());
  CHECK(n_lines_sent(rig, "$X") == 0);
  CHECK_FALSE(rig.stage.is_unlocked_unhomed());
  CHECK(rig.stage.position_m() == Approx(stood_m).margin(1e-6));
  rig.stage.begin_move(stood_m + 0.1e-3, 0.1e-3, "test");
  pump_for(rig, 0.1);
  rig.stage.stop_hard();  // in motion it locks itself
  rig.stage.recover(rig.pump());
  CHECK(n_lines_sent(rig, "$X") == 1);
  CHECK(rig.stage.is_unlocked_unhomed());
}

TEST_CASE("after a limit switch the controller is silent until it is reset", "[rig][pty]") {
  RigFixture rig(RigFixture::options());
  rig.stage.connect(rig.pump());
  rig.stage.begin_move(1e-3, 0.2e-3, "test");
  const Pump pump = rig.pump();
  rig.emulated.cause(Incident::kHitLimitSwitch);
  CHECK_THROWS_AS(
      [&] {
        while (rig.stage.is_moving()) pump();
      }(),
      StageAlarm);
  rig.stage.recover(pump);
  CHECK(rig.stage.state() == "Idle");
}

TEST_CASE("a controller that restarts in a move, or is lost, ends it with an error", "[rig][pty]") {
  RigFixture rig(RigFixture::options());
  rig.stage.connect(rig.pump());
  rig.stage.begin_move(1e-3, 0.1e-3, "test");
  const Pump pump = rig.pump();
  const auto wait = [&] {
    while (rig.stage.is_moving()) pump();
  };
  SECTION("restart") {
    rig.emulated.cause(Incident::kRestartStage);
    CHECK_THROWS_AS(wait(), DeviceRestarted);
  }
  SECTION("cable pulled") {
    rig.emulated.cause(Incident::kPullStageCable);
    CHECK_THROWS_AS(wait(), PortHungUp);
  }
}

TEST_CASE("moves beyond the travel of the rig file are refused", "[rig][pty]") {
  RigFixture rig(RigFixture::options());
  rig.stage.connect(rig.pump());
  CHECK_THROWS_WITH(rig.stage.begin_move(10.1e-3, 1e-3, "test"), Contains("travel"));
  CHECK_FALSE(rig.stage.is_moving());
}

TEST_CASE("a port where no controller answers is named in the error", "[rig][pty]") {
  EmulatedRig emulated(RigFixture::options());
  const RigClock clock = emulated.clock();
  SerialLine line(emulated.load_cell_port(), 115200, clock);  // the wrong one
  GrblStage stage(
      line, StageConfig{}, clock, [](const RunRecord&) {}, 0.1);
  CHECK_THROWS_WITH(stage.connect([&] {
    wait_readable({&line}, clock, 0.01);
    stage.service();
  }),
                    Contains("no GRBL controller answered"));
}

TEST_CASE("settings that would spoil a test are reported as advice", "[rig][pty]") {
  EmulatedRigOptions options = RigFixture::options();
  options.truth.steps_per_m = 250e3;
  options.truth.acceleration_m_s2 = 0.01;
  RigFixture rig(options);
  rig.stage.connect(rig.pump());
  rig.stage.command("$1=25", rig.pump());
  rig.stage.command("$$", rig.pump());
  const auto advice = rig.stage.advice();
  REQUIRE(advice.size() == 4);
  CHECK_THAT(advice[0], Contains("set $1=255"));
  CHECK_THAT(advice[1], Contains("30.0 um"));
  CHECK_THROWS_WITH(rig.stage.command("$J=G91Z1", rig.pump()), Contains("error 22"));
}

}  // namespace viscard
