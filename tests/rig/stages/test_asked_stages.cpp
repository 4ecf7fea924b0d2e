// What the drivers of controllers without numbered answers and checksums (PI, Newport) share.
#include "rig/stages/stage.h"
#include "tests/rig/stages/asked_rig.h"

#include <catch2/catch.hpp>

namespace viscard {
namespace {

using Catch::Matchers::Contains;

// Of each driver in turn.
EmulatedRigOptions asked_rig() {
  return DeviceFixture::options(GENERATE("pi-gcs2", "smc100"));
}

}  // namespace

TEST_CASE("a PI or Newport stage at a wrong baud rate names the setting", "[rig]") {
  struct Idle final : WaitingRig {
    double time_s = 0.0;
    double now_s() const override { return time_s; }
    void pass(double longest_s) override { time_s += longest_s; }
  } idle;
  struct Noise final : Transport {
    std::string name() const override { return "noise"; }
    int baud() const override { return 9600; }
    int descriptor() const override { return -1; }
    Chunk read_available() override { return {0.0, "\xf3\x81z\xee"}; }
    void write(std::string_view, double) override {}
  } noise;
  const RigClock clock(idle);
  StageConfig config;
  config.driver = GENERATE("pi-gcs2", "smc100");
  const auto stage = make_stage(noise, config, clock, [](const RunRecord&) {});
  const Pump pump = [&] {
    clock.pass(0.01);
    stage->service();
  };
  CHECK_THROWS_WITH(stage->connect(pump), Contains("unreadable") && Contains("baud"));
}

TEST_CASE(
    "a PI or Newport stage that cannot follow or meets a limit raises an alarm with its words",
    "[rig][pty]") {
  EmulatedRigOptions options = asked_rig();
  const bool is_limit = GENERATE(false, true);
  options.pi.limit_keeps_servo = options.smc.limit_keeps_motor = is_limit;
  const char* at_limit = options.config.stage.driver == "smc100" ? "positive end" : "limit switch";
  DeviceFixture rig(options);
  Stage& stage = *rig.devices.stage;
  stage.connect(rig.pump());
  stage.begin_move(2e-3, 0.5e-3, "approach");
  pump_into_move(rig, 0.3);
  rig.emulated.cause(Incident::kHitLimitSwitch);
  try {
    rig.pump_for(4.0);
    FAIL("no alarm");
  } catch (const StageAlarm& alarm) {
    CHECK_THAT(alarm.what(), Contains(is_limit ? at_limit : "could not follow"));
  }
  stage.recover(rig.pump());
  CHECK(rig.move(0.0, 2e-3));
}

TEST_CASE("a PI or Newport stage stops gently or at once although answers are lost", "[rig][pty]") {
  EmulatedRigOptions options = asked_rig();
  answers_of(options).lose_every = 5;
  DeviceFixture rig(options);
  Stage& stage = *rig.devices.stage;
  stage.connect(rig.pump());
  stage.begin_move(2e-3, 1e-3, "approach");
  pump_into_move(rig, 0.3);
  stage.stop_soft();
  while (stage.is_moving()) rig.pump()();
  const double stopped_m = stage.position_m();
  CHECK(stopped_m > 0.01e-3);
  CHECK(stopped_m < 1.0e-3);
  REQUIRE(rig.all<CommandedMove>().size() == 1);
  CHECK(rig.all<CommandedMove>().back().move.to_m == Approx(stopped_m).margin(1e-12));
  stage.begin_move(2e-3, 1e-3, "approach");
  pump_into_move(rig, 0.2);
  stage.stop_hard();
  stage.recover(rig.pump());
  CHECK_FALSE(stage.is_moving());
  CHECK(stage.position_m() < 1.9e-3);
  CHECK(stage.position_m() == Approx(rig.emulated.outcome().final_position_m).margin(1e-9));
  REQUIRE(rig.move(0.0, 2e-3));
}

TEST_CASE("a stop of a PI or Newport stage before its move was written leaves it where it is",
          "[rig][pty]") {
  DeviceFixture rig(asked_rig());
  Stage& stage = *rig.devices.stage;
  stage.connect(rig.pump());
  stage.begin_move(2e-3, 1e-3, "approach");
  stage.stop_soft();
  while (stage.is_moving()) rig.pump()();
  rig.pump_for(0.5);
  CHECK(rig.emulated.outcome().final_position_m == 0.0);
  CHECK(n_moves_written(rig) == 0);
  CHECK(rig.all<CommandedMove>().empty());
}

TEST_CASE(
    "a whole test on a PI or Newport stage presses with the force of its specimen although "
    "answers are late",
    "[rig][pty]") {
  EmulatedRigOptions options = asked_rig();
  answers_of(options).late_every = 199;
  DeviceFixture rig(options);
  const RunOutcome outcome = rig.run(shortest_stage_plan());
  INFO(outcome.reason);
  REQUIRE(outcome.status == "finished");
  CHECK(outcome.achieved_depth_m == Approx(0.13e-3).margin(4e-6));  // contact is found to a few um
  CHECK(rig.emulated.outcome().peak_force_N == Approx(outcome.expected.peak_force_N).epsilon(0.05));
  CHECK(rig.emulated.outcome().final_position_m < demo_truth(10.0, 7).surface_position_m);
  for (const CommandedMove& move : rig.all<CommandedMove>()) {
    if (move.purpose != "ramp") continue;
    CHECK(move.start_uncertainty_s < 0.03);  // the reports bound it
  }
}

}  // namespace viscard
