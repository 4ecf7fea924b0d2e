#include "rig/protocols/pi_protocol.h"
#include "rig/stages/stage.h"
#include "tests/rig/stages/asked_rig.h"

#include <catch2/catch.hpp>

namespace viscard {
namespace {

using Catch::Matchers::Contains;

EmulatedRigOptions pi_rig() {
  return DeviceFixture::options("pi-gcs2");
}

}  // namespace

TEST_CASE("PI commands have an address on a chain and no line end after a single byte", "[rig]") {
  CHECK(format_pi_command(1, "MOV 1 -0.25") == "MOV 1 -0.25\n");
  CHECK(format_pi_command(3, "POS? 1") == "3 POS? 1\n");
  CHECK(format_pi_command(1, std::string(1, kPiStop)) == "\x18");
  CHECK(format_pi_command(3, std::string(1, kPiIsMoving)) == "3 \x05");
  CHECK(format_pi_command(3, std::string(1, kPiStop)) ==
        "\x18"
        "3 \x18\n");
}

TEST_CASE("PI answers are read with and without an address, on one line or several", "[rig]") {
  CHECK(pi_answer_text("1=-0.2500000", 3).value() == "1=-0.2500000");
  CHECK(pi_answer_text("0 3 1=0.5", 3).value() == "1=0.5");
  CHECK_FALSE(pi_answer_text("0 4 1=0.5", 3).has_value());
  CHECK(pi_value_of_axis("1=-0.2500000", 1).value() == "-0.2500000");
  CHECK(pi_value_of_axis("1=0.1 \n2=0.7", 2).value() == "0.7");
  CHECK(pi_value_of_axis("1 0xE=2048", 1).value() == "2048");
  CHECK_FALSE(pi_value_of_axis("2=1", 1).has_value());
  CHECK_FALSE(pi_value_of_axis("11=1", 1).has_value());
  CHECK(parse_pi_moving("0", 1) == false);
  CHECK(parse_pi_moving("5", 3) == true);
  CHECK(parse_pi_moving("5", 2) == false);
  CHECK_FALSE(parse_pi_moving("1=1", 1).has_value());
  CHECK_FALSE(parse_pi_moving("", 1).has_value());
  CHECK(parse_pi_ready("\xb1") == true);
  CHECK(parse_pi_ready("\xb0") == false);
  CHECK_FALSE(parse_pi_ready("1").has_value());
  CHECK(parse_pi_error("1024") == 1024);
  CHECK_FALSE(parse_pi_error("1=0").has_value());
  CHECK(is_pi_identity("(c)2013 Physik Instrumente (PI) Karlsruhe, C-863.11, 0, 1.2.1.0"));
  CHECK_THAT(pi_error_text(1024), Contains("obstacle"));
  CHECK(pi_error_text(77) == "error 77");
}

TEST_CASE("a PI stage reports its dynamics and reaches its target at the speed asked for",
          "[rig][pty]") {
  EmulatedRigOptions options = pi_rig();
  double acceleration_m_s2 = 0.2;
  SECTION("as it comes") {}
  SECTION("as the third of a chain, on its second axis, the other way round") {
    options.config.stage.device = 3;
    options.config.stage.axis_number = 2;
    options.config.stage.toward_specimen = 1;
  }
  SECTION("with an error of another program and two axes in each answer") {
    options.pi = {.lists_two_axes = true, .stale_error = 7};
  }
  SECTION("with lost answers") {
    options.pi.answers.lose_every = 9;
  }
  SECTION("with late answers") {
    options.pi.answers.late_every = 11;
  }
  SECTION("slow to answer") {
    options.pi.answers.delay_s = 0.2;
  }
  SECTION("without parameters, with a slower deceleration") {
    options.pi = {.has_parameters = false, .deceleration_ratio = 0.5};
    acceleration_m_s2 = 0.1;
  }
  DeviceFixture rig(options);
  rig.devices.stage->connect(rig.pump());
  const StageDynamics dynamics = rig.devices.stage->dynamics();
  CHECK(dynamics.steps_per_m == Approx(3200e3).epsilon(1e-9));
  CHECK(dynamics.max_speed_m_s == Approx(options.pi.has_parameters ? 10e-3 : 5e-3).epsilon(1e-6));
  CHECK(dynamics.acceleration_m_s2 == Approx(acceleration_m_s2).epsilon(1e-6));
  CHECK(dynamics.lowest_m == Approx(-25e-3));
  REQUIRE(rig.move(0.5e-3, 0.25e-3));
  REQUIRE(rig.move(0.3e-3, 2e-3));
  CHECK(rig.emulated.outcome().final_position_m == Approx(0.3e-3).margin(1e-9));
  CHECK(rig.devices.stage->position_m() == Approx(0.3e-3).margin(1e-9));
  CHECK(n_moves_written(rig) == 2);
  const auto moves = rig.all<CommandedMove>();
  REQUIRE(moves.size() == 2);
  CHECK(moves[0].move.to_m == Approx(0.5e-3).margin(1e-9));
  CHECK(moves[0].move.speed_m_s == Approx(0.25e-3).epsilon(1e-6));
  CHECK(moves[1].move.from_m == Approx(0.5e-3).margin(1e-9));
}

TEST_CASE("the stop byte of a PI stage acts at once", "[rig][pty]") {
  EmulatedRigOptions options = pi_rig();
  options.config.stage.device = GENERATE(1, 4);
  DeviceFixture rig(options);
  Stage& stage = *rig.devices.stage;
  stage.connect(rig.pump());
  stage.begin_move(2e-3, 1e-3, "approach");
  pump_into_move(rig, 0.3);
  stage.stop_hard();
  rig.pump_for(0.005);
  CHECK_FALSE(rig.emulated.outcome().is_moving);
  stage.recover(rig.pump());
  CHECK(rig.move(0.0, 1e-3));
}

TEST_CASE("a PI stage whose supply is cut has restarted, and still lifts the punch", "[rig][pty]") {
  EmulatedRigOptions options = pi_rig();
  options.pi.loses_power = true;
  options.config.stage.toward_specimen = 1;
  options.pi.lowest_mm = 0.0;  // the stage starts at the end of its travel
  const bool is_moving = GENERATE(false, true);
  DeviceFixture rig(options);
  Stage& stage = *rig.devices.stage;
  stage.connect(rig.pump());
  REQUIRE(rig.move(0.5e-3, 1e-3));
  if (is_moving) stage.begin_move(0.9e-3, 0.1e-3, "ramp");
  pump_into_move(rig, 0.3);
  rig.emulated.cause(Incident::kRestartStage);
  CHECK_THROWS_AS(rig.pump_for(2.0), DeviceRestarted);
  stage.recover(rig.pump());
  const double before_m = rig.emulated.outcome().final_position_m;
  REQUIRE(rig.move(stage.position_m() - 0.2e-3, 0.2e-3));
  CHECK(rig.emulated.outcome().final_position_m == Approx(before_m - 0.2e-3).margin(1e-9));
}

TEST_CASE("a PI stage without a reference position is refused unless it may home", "[rig][pty]") {
  EmulatedRigOptions options = pi_rig();
  options.pi.has_reference = false;
  SECTION("refused") {
    DeviceFixture rig(options);
    CHECK_THROWS_WITH(rig.devices.stage->connect(rig.pump()), Contains("home"));
  }
  SECTION("homed") {
    options.config.stage.home = true;
    DeviceFixture rig(options);
    rig.devices.stage->connect(rig.pump());
    CHECK(rig.move(0.2e-3, 1e-3));
  }
}

TEST_CASE("a PI stage that never reports to be on target ends where it rests", "[rig][pty]") {
  EmulatedRigOptions options = pi_rig();
  options.pi = {.comes_on_target = false, .counts_beside_target = 4};
  DeviceFixture rig(options);
  rig.devices.stage->connect(rig.pump());
  REQUIRE(rig.move(0.5e-3, 1e-3));
  CHECK(rig.devices.stage->position_m() == Approx(0.5e-3 + 4.0 / 3200e3).margin(1e-9));
  CHECK(rig.all<CommandedMove>().back().move.to_m == Approx(0.5e-3 + 4.0 / 3200e3).margin(1e-9));
}

TEST_CASE("a PI stage that rests a little short of its target is not late", "[rig][pty]") {
  EmulatedRigOptions options = pi_rig();
  options.pi = {.comes_on_target = false, .counts_beside_target = -4};
  DeviceFixture rig(options);
  rig.devices.stage->connect(rig.pump());
  REQUIRE(rig.move(0.5e-3, 1e-3));
  CHECK(rig.devices.stage->position_m() == Approx(0.5e-3 - 4.0 / 3200e3).margin(1e-9));
  CHECK(rig.devices.stage->lag_s() == 0.0);
  for (const RunEvent& event : rig.all<RunEvent>()) CHECK(event.name != "move_doubtful");
}

TEST_CASE("a PI stage that rests far from its target is an error", "[rig][pty]") {
  EmulatedRigOptions options = pi_rig();
  options.pi.counts_beside_target = -100;
  DeviceFixture rig(options);
  rig.devices.stage->connect(rig.pump());
  CHECK_THROWS_WITH(rig.move(0.5e-3, 1e-3), Contains("did not reach"));
}

TEST_CASE("a move of a PI stage ends at the limits of its controller", "[rig][pty]") {
  EmulatedRigOptions options = pi_rig();
  options.pi = {.lowest_mm = -1.0, .highest_mm = 0.1};  // machine; the specimen is at -1
  DeviceFixture rig(options);
  rig.devices.stage->connect(rig.pump());
  REQUIRE(rig.move(0.4e-3, 1e-3));
  REQUIRE(rig.move(-0.4e-3, 1e-3));
  CHECK(rig.devices.stage->position_m() == Approx(-0.1e-3).margin(1e-9));
  CHECK_THROWS_WITH(rig.move(1.5e-3, 1e-3), Contains("TMN"));
}

TEST_CASE("another device on the port of a PI stage is quoted, and silence names the switches",
          "[rig][pty]") {
  EmulatedRigOptions options = pi_rig();
  SECTION("another device") {
    options.config.stage.driver = "grbl";
    DeviceFixture rig(options);
    StageConfig config = rig.config.stage;
    config.driver = "pi-gcs2";
    rig.devices.stage = make_stage(*rig.devices.stage_line, config, rig.clock, rig.sink);
    CHECK_THROWS_WITH(rig.devices.stage->connect(rig.pump()), Contains("GRBL"));
  }
  SECTION("another address") {
    DeviceFixture rig(options);
    StageConfig config = rig.config.stage;
    config.device = 5;
    rig.devices.stage = make_stage(*rig.devices.stage_line, config, rig.clock, rig.sink);
    CHECK_THROWS_WITH(rig.devices.stage->connect(rig.pump()),
                      Contains("address 5") && Contains("switches"));
  }
}

}  // namespace viscard
