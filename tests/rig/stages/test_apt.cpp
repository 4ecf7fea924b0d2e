#include "rig/emulator/pty_port.h"
#include "rig/stages/apt_stage.h"
#include "tests/rig/stages/stage_rig.h"

#include <catch2/catch.hpp>

namespace viscard {
namespace {

using Catch::Matchers::Contains;

EmulatedRigOptions apt_rig() {
  return stage_rig("apt");
}

// How often the unit was sent a move.
std::size_t n_moves_sent(const DeviceFixture& rig) {
  const std::string move = format_apt_move(0).substr(0, 6);
  std::size_t n = 0;
  for (const RawBytes& raw : rig.all<RawBytes>()) {
    n += raw.device == Device::kStage && raw.is_sent && raw.bytes.rfind(move, 0) == 0 ? 1 : 0;
  }
  return n;
}

std::string error_of_apt_on(const std::string& sent) {
  PtyPort device;
  const RigClock clock;
  SerialLine line(device.path(), 115200, clock);
  StageConfig config;
  config.microstep_m = 1e-7;
  AptStage stage(line, config, clock, [](const RunRecord&) {});
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

}  // namespace

TEST_CASE("an APT stage reports its dynamics and reaches its target at the speed asked for",
          "[rig][pty]") {
  EmulatedRigOptions options = apt_rig();
  SECTION("as it comes") {}
  SECTION("a stepper") {
    options.apt.model = "LTS150";
  }
  SECTION("no event when a move has ended") {
    options.apt.sends_events = false;
  }
  SECTION("events with a status, between each question and its answer") {
    options.apt.events_carry_status = true;
    options.apt.sends_event_before_reply = true;
  }
  SECTION("lost answers") {
    options.apt.lose_reply_every = 5;
  }
  SECTION("answers in two halves") {
    options.apt.pause_reply_every = 3;
  }
  SECTION("answers whose second half comes too late") {
    options.apt.pause_reply_every = 7;
    options.apt.pause_s = 0.8;
  }
  SECTION("late answers") {
    options.apt.reply_delay_s = 0.4;
  }
  SECTION("late motion") {
    options.apt.start_delay_s = 0.2;
  }
  SECTION("a lost move") {
    options.apt.lose_move_number = 2;
  }
  SECTION("a lost speed") {
    options.apt.lose_speed_number = 2;
  }
  SECTION("mounted the other way round") {
    options.config.stage.toward_specimen = 1;
  }
  DeviceFixture rig(options);
  rig.devices.stage->connect(rig.pump());
  CHECK_THAT(rig.devices.stage->identity(), Contains(options.apt.model));
  const StageDynamics dynamics = rig.devices.stage->dynamics();
  CHECK(dynamics.steps_per_m == Approx(34304e3).epsilon(1e-9));
  CHECK(dynamics.max_speed_m_s == Approx(2.4e-3).epsilon(1e-4));
  CHECK(dynamics.acceleration_m_s2 == Approx(4e-3).epsilon(2e-3));  // 1048 words
  REQUIRE(rig.move(0.5e-3, 0.25e-3));
  REQUIRE(rig.move(0.3e-3, 2e-3));
  const double count_m = 1.0 / 34304e3;
  CHECK(rig.emulated.outcome().final_position_m == Approx(0.3e-3).margin(count_m));
  CHECK(rig.devices.stage->position_m() == Approx(0.3e-3).margin(count_m));
  const auto moves = rig.all<CommandedMove>();
  REQUIRE(moves.size() == 2);
  CHECK(moves[0].move.to_m == Approx(0.5e-3).margin(count_m));
  CHECK(moves[0].move.speed_m_s == Approx(0.25e-3).epsilon(1e-4));
  CHECK(moves[1].move.from_m == Approx(0.5e-3).margin(count_m));
  CHECK(n_moves_sent(rig) == (options.apt.lose_move_number > 0 ? 3 : 2));
}

TEST_CASE("a move of an APT stage of a single count is made once", "[rig][pty]") {
  EmulatedRigOptions options = apt_rig();
  options.apt.start_delay_s = GENERATE(0.0, 0.3);
  DeviceFixture rig(options);
  rig.devices.stage->connect(rig.pump());
  const double count_m = 1.0 / 34304e3;
  REQUIRE(rig.move(count_m, 1e-3));
  CHECK(rig.emulated.outcome().final_position_m == Approx(count_m).margin(1e-12));
  CHECK(n_moves_sent(rig) == 1);
}

TEST_CASE("an APT stage stops gently or at once and can be moved again", "[rig][pty]") {
  EmulatedRigOptions options = apt_rig();
  // The first stop is that of connect(), the second the gentle one, the third the hard one.
  options.apt.lose_stop_number = GENERATE(0, 2, 3);
  DeviceFixture rig(options);
  Stage& stage = *rig.devices.stage;
  stage.connect(rig.pump());
  stage.begin_move(3e-3, 1e-3, "approach");
  rig.pump_for(0.5);
  stage.stop_soft();
  while (stage.is_moving()) rig.pump()();
  const double stopped_m = stage.position_m();
  CHECK(stopped_m > 0.1e-3);
  CHECK(stopped_m < 1.5e-3);
  CHECK_FALSE(rig.emulated.outcome().is_moving);
  CHECK(rig.all<CommandedMove>().back().move.to_m == Approx(stopped_m).margin(1e-12));
  stage.begin_move(5e-3, 1e-3, "approach");
  rig.pump_for(0.4);
  stage.stop_hard();
  stage.recover(rig.pump());
  CHECK_FALSE(stage.is_moving());
  CHECK(stage.position_m() < 3e-3);
  CHECK(rig.emulated.outcome().final_position_m == Approx(stage.position_m()).margin(1e-9));
  REQUIRE(rig.move(0.0, 2e-3));
}

TEST_CASE("an APT stage that is stopped before its move was sent does not move", "[rig][pty]") {
  EmulatedRigOptions options = apt_rig();
  options.apt.reply_delay_s = 0.1;
  DeviceFixture rig(options);
  Stage& stage = *rig.devices.stage;
  stage.connect(rig.pump());
  stage.begin_move(2e-3, 1e-3, "approach");
  rig.pump_for(0.05);
  stage.stop_soft();
  while (stage.is_moving()) rig.pump()();
  rig.pump_for(1.0);
  CHECK(n_moves_sent(rig) == 0);
  CHECK(rig.emulated.outcome().final_position_m == 0.0);
  CHECK(rig.all<CommandedMove>().empty());
  CHECK(rig.move(0.2e-3, 1e-3));
}

TEST_CASE("an APT stage that ends short or leaves its path is noticed", "[rig][pty]") {
  EmulatedRigOptions options = apt_rig();
  SECTION("short") {
    options.apt.ends_short_number = 1;
    DeviceFixture rig(options);
    rig.devices.stage->connect(rig.pump());
    CHECK_THROWS_WITH(rig.move(0.5e-3, 1e-3), Contains("did not reach 0.5000 mm"));
  }
  SECTION("astray") {
    options.apt.misread_move_number = 1;
    DeviceFixture rig(options);
    rig.devices.stage->connect(rig.pump());
    CHECK_THROWS_AS(rig.move(0.5e-3, 1e-3), StageAlarm);
    rig.devices.stage->recover(rig.pump());
    CHECK(rig.emulated.outcome().final_position_m < 0.7e-3);
    CHECK(rig.move(0.0, 2e-3));
  }
}

TEST_CASE("an APT stage without a reference position is refused unless it may home", "[rig][pty]") {
  EmulatedRigOptions options = apt_rig();
  options.apt.is_homed = false;
  SECTION("refused") {
    DeviceFixture rig(options);
    CHECK_THROWS_WITH(rig.devices.stage->connect(rig.pump()), Contains("home"));
  }
  SECTION("homed") {
    options.config.stage.home = true;
    options.apt.sends_events = GENERATE(true, false);
    options.apt.has_no_speed = GENERATE(true, false);
    options.apt.start_delay_s = 0.1;
    DeviceFixture rig(options);
    rig.devices.stage->connect(rig.pump());
    CHECK(rig.move(0.2e-3, 1e-3));
  }
}

TEST_CASE("an APT stage whose own speed is 0 moves with usual values and says so", "[rig][pty]") {
  EmulatedRigOptions options = apt_rig();
  options.apt.has_no_speed = true;
  DeviceFixture rig(options);
  Stage& stage = *rig.devices.stage;
  stage.connect(rig.pump());
  CHECK(stage.dynamics().max_speed_m_s == Approx(1e-3).epsilon(1e-4));
  CHECK(stage.dynamics().acceleration_m_s2 == Approx(1e-3).epsilon(5e-3));
  REQUIRE_FALSE(stage.advice().empty());
  CHECK_THAT(stage.advice().front(), Contains("1 mm/s"));
  CHECK(rig.move(0.2e-3, 1e-3));
}

TEST_CASE("an APT stage whose motor stays off, or of an unknown model, is refused", "[rig][pty]") {
  EmulatedRigOptions options = apt_rig();
  SECTION("off") {
    options.apt.stays_disabled = true;
    DeviceFixture rig(options);
    CHECK_THROWS_WITH(rig.devices.stage->connect(rig.pump()), Contains("switched off"));
  }
  SECTION("unknown") {
    options.apt.model = "KPZ101";
    DeviceFixture rig(options);
    CHECK_THROWS_WITH(rig.devices.stage->connect(rig.pump()),
                      Contains("KPZ101") && Contains("KDC, TDC, KST"));
  }
}

TEST_CASE("an APT stage without microstep in the rig file is refused with usual values", "[rig]") {
  PtyPort device;
  const RigClock clock;
  SerialLine line(device.path(), 115200, clock);
  StageConfig config;
  config.driver = "apt";
  CHECK_THROWS_WITH(make_stage(line, config, clock, [](const RunRecord&) {}),
                    Contains("microstep") && Contains("34304") && Contains("34554.96"));
}

TEST_CASE("what answers instead of an APT unit is quoted", "[rig][pty]") {
  CHECK_THAT(error_of_apt_on("8388607\r\n8388610\r\n"),
             Contains("It sent '8388607'") && Contains("swapped"));
  CHECK_THAT(error_of_apt_on(std::string(40, '\xf8')), Contains("115200"));
  CHECK_THAT(error_of_apt_on(""), Contains("switched on"));
}

TEST_CASE("a whole test runs on an APT stepper, and the punch leaves the specimen", "[rig][pty]") {
  EmulatedRigOptions options = apt_rig();
  options.apt.model = "KST101";
  DeviceFixture rig(options);
  const RunOutcome outcome = rig.run(shortest_stage_plan());
  INFO(outcome.reason);
  REQUIRE(outcome.status == "finished");
  CHECK(outcome.achieved_depth_m == Approx(0.13e-3).margin(4e-6));
  CHECK(rig.emulated.outcome().final_position_m < demo_truth(10.0, 7).surface_position_m);
}

}  // namespace viscard
