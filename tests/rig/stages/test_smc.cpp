#include "rig/protocols/smc_protocol.h"
#include "rig/stages/stage.h"
#include "tests/rig/stages/asked_rig.h"

#include <catch2/catch.hpp>

namespace viscard {
namespace {

using Catch::Matchers::Contains;

EmulatedRigOptions smc_rig() {
  return DeviceFixture::options("smc100");
}

bool has_warning(const DeviceFixture& rig, const std::string& name) {
  for (const RunEvent& event : rig.all<RunEvent>()) {
    if (event.name == name) return true;
  }
  return false;
}

}  // namespace

TEST_CASE("Newport commands and answers carry the address and the letters", "[rig]") {
  CHECK(format_smc_command(1, "PA-0.25") == "1PA-0.25\r\n");
  CHECK(format_smc_command(31, "TP") == "31TP\r\n");
  CHECK(smc_answer_text("1TP-0.25003", 1, "TP").value() == "-0.25003");
  CHECK(smc_answer_text("1VA0.4", 1, "VA?").value() == "0.4");
  CHECK(smc_answer_text("1TE@", 1, "TE").value() == "@");
  CHECK_FALSE(smc_answer_text("1TP-0.25003", 1, "TS").has_value());
  CHECK_FALSE(smc_answer_text("11TP-0.25003", 1, "TP").has_value());
  CHECK_FALSE(smc_answer_text("2TP-0.25003", 1, "TP").has_value());
  CHECK_FALSE(smc_answer_text(std::string_view("1TP\0000.25", 8), 1, "TP").has_value());
  CHECK_FALSE(smc_answer_text("", 1, "TP").has_value());
}

TEST_CASE("Newport states are told apart by their hexadecimal digits", "[rig]") {
  CHECK_FALSE(is_smc_referenced(*parse_smc_state("00000A")));
  CHECK(is_smc_moving(*parse_smc_state("000028")));
  CHECK(is_smc_ready(*parse_smc_state("000033")));
  const auto homing = parse_smc_state("00001E");  // not 1
  REQUIRE(homing);
  CHECK(is_smc_homing(*homing));
  CHECK(is_smc_moving(*homing));
  CHECK_FALSE(is_smc_referenced(*homing));
  const auto failed = parse_smc_state("00203D");
  REQUIRE(failed);
  CHECK(is_smc_disabled(*failed));
  CHECK_THAT(smc_fault_text(failed->faults), Contains("could not follow"));
  CHECK(smc_fault_text(parse_smc_state("000133")->faults).find("negative end") == 4);
  CHECK(smc_fault_text(0).empty());
  for (const char* text : {"", "28", "0000028", "00002G", "000099", "0x0028", "000000"}) {
    INFO(text);
    CHECK_FALSE(parse_smc_state(text).has_value());
  }
  CHECK(smc_error_text("@").empty());
  CHECK_THAT(smc_error_text("H"), Contains("home"));
  CHECK(smc_error_text("q") == "error q");
}

TEST_CASE("a Newport stage reports its dynamics and reaches its target at the speed asked for",
          "[rig][pty]") {
  EmulatedRigOptions options = smc_rig();
  SECTION("as it comes") {}
  SECTION("as the third of a chain, the other way round") {
    options.config.stage.device = 3;
    options.config.stage.toward_specimen = 1;
  }
  SECTION("a stepper with an error of another program, and without an answer to PA?") {
    options.smc.is_pp = true;
    options.smc.knows_target = false;
    options.smc.stale_error = 'C';
  }
  SECTION("with lost answers") {
    options.smc.answers.lose_every = 9;
  }
  SECTION("with late answers") {
    options.smc.answers.late_every = 11;
  }
  SECTION("slow to answer") {
    options.smc.answers.delay_s = 0.2;
  }
  SECTION("with XOFF") {
    options.smc.hold_every = 4;
  }
  DeviceFixture rig(options);
  rig.devices.stage->connect(rig.pump());
  const StageDynamics dynamics = rig.devices.stage->dynamics();
  CHECK(dynamics.steps_per_m == Approx(3200e3).epsilon(1e-9));
  CHECK(dynamics.max_speed_m_s == Approx(10e-3).epsilon(1e-6));
  CHECK(dynamics.acceleration_m_s2 == Approx(0.2).epsilon(1e-6));
  CHECK(dynamics.lowest_m == Approx(-25e-3));
  REQUIRE(rig.move(0.5e-3, 0.25e-3));
  REQUIRE(rig.move(0.3e-3, 2e-3));
  CHECK(rig.emulated.outcome().final_position_m == Approx(0.3e-3).margin(1e-9));
  CHECK(rig.devices.stage->position_m() == Approx(0.3e-3).margin(1e-9));
  CHECK(n_moves_written(rig) == 2);
  CHECK_FALSE(has_warning(rig, "stage_flow_control"));
  const auto moves = rig.all<CommandedMove>();
  REQUIRE(moves.size() == 2);
  CHECK(moves[0].move.to_m == Approx(0.5e-3).margin(1e-9));
  CHECK(moves[0].move.speed_m_s == Approx(0.25e-3).epsilon(1e-6));
  CHECK(moves[1].move.from_m == Approx(0.5e-3).margin(1e-9));
}

TEST_CASE("a Newport stage without a reference position is refused unless it may home",
          "[rig][pty]") {
  EmulatedRigOptions options = smc_rig();
  options.smc.has_reference = false;
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
  SECTION("in vain") {
    options.config.stage.home = true;
    options.smc.fails_to_home = true;
    DeviceFixture rig(options);
    CHECK_THROWS_WITH(rig.devices.stage->connect(rig.pump()), Contains("homing took too long"));
  }
}

TEST_CASE("a Newport stepper needs the length of its microstep", "[rig][pty]") {
  EmulatedRigOptions options = smc_rig();
  options.smc.is_pp = true;
  DeviceFixture rig(options);
  StageConfig config = rig.config.stage;
  config.microstep_m = 0.0;
  rig.devices.stage = make_stage(*rig.devices.stage_line, config, rig.clock, rig.sink);
  CHECK_THROWS_WITH(rig.devices.stage->connect(rig.pump()), Contains("microstep"));
}

TEST_CASE("a long jerk time of a Newport stage is reported as advice", "[rig][pty]") {
  EmulatedRigOptions options = smc_rig();
  options.smc.jerk_time_s = 0.04;
  DeviceFixture rig(options);
  rig.devices.stage->connect(rig.pump());
  REQUIRE(rig.devices.stage->advice().size() == 1);
  CHECK_THAT(rig.devices.stage->advice()[0], Contains("JR"));
}

TEST_CASE("a stop of a Newport stage is written although it has sent XOFF", "[rig][pty]") {
  EmulatedRigOptions options = smc_rig();
  options.smc.hold_every = 2;
  DeviceFixture rig(options);
  Stage& stage = *rig.devices.stage;
  stage.connect(rig.pump());
  stage.begin_move(5e-3, 1e-3, "approach");
  pump_into_move(rig, 0.3);
  stage.stop_soft();
  rig.pump_for(0.2);
  CHECK_FALSE(rig.emulated.outcome().is_moving);
  while (stage.is_moving()) rig.pump()();
  CHECK(stage.position_m() == Approx(rig.emulated.outcome().final_position_m).margin(1e-9));
}

TEST_CASE("another device on the port of a Newport stage is quoted", "[rig][pty]") {
  DeviceFixture rig(DeviceFixture::options("zaber"));
  StageConfig config = rig.config.stage;
  config.driver = "smc100";
  config.device = 5;
  rig.devices.stage = make_stage(*rig.devices.stage_line, config, rig.clock, rig.sink);
  CHECK_THROWS_WITH(rig.devices.stage->connect(rig.pump()),
                    Contains("address 5") && Contains("57600"));
}

}  // namespace viscard
