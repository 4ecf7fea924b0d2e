// Behaviour of real controllers beyond their documentation: one habit of the emulator at a time.
#include "rig/stages/polled_stage.h"
#include "tests/rig/rig_fixture.h"

#include <catch2/catch.hpp>

namespace viscard {
namespace {

using Catch::Matchers::Contains;

bool stands_where_it_says(const RigFixture& rig) {
  const EmulatedOutcome bench = rig.emulated.outcome();
  return !bench.is_moving && std::abs(bench.final_position_m - rig.stage.position_m()) < 0.6e-6;
}

}  // namespace

TEST_CASE("start-up blocks and the settings of an empty memory are not taken for answers",
          "[rig][pty]") {
  EmulatedRigOptions options = RigFixture::options();
  options.grbl.has_startup_block = true;
  options.grbl.has_empty_eeprom = true;
  options.grbl.is_hal = GENERATE(false, true);
  RigFixture rig(options);
  rig.stage.connect(rig.pump());
  move_and_wait(rig, 0.1e-3, 1e-3);
  CHECK(stands_where_it_says(rig));
  CHECK(rig.all<CommandedMove>().size() == 1);
}

TEST_CASE("reports in inches give the same metres", "[rig][pty]") {
  EmulatedRigOptions options = RigFixture::options();
  options.grbl.reports_inches = true;
  RigFixture rig(options);
  rig.stage.connect(rig.pump());
  move_and_wait(rig, 0.3e-3, 1e-3);
  CHECK(rig.stage.position_m() == Approx(0.3e-3).margin(0.5 / 3200e3));
  CHECK(rig.emulated.outcome().final_position_m == Approx(0.3e-3).margin(0.5 / 3200e3));
}

TEST_CASE("a speed below the smallest of the firmware is recorded as that smallest speed",
          "[rig][pty]") {
  // 30.5 steps/s at 250 steps/mm is 0.1221 mm/s (gnea/grbl stepper.c), for any slower speed.
  EmulatedRigOptions options = RigFixture::options();
  options.truth.steps_per_m = 250e3;
  RigFixture rig(options);
  rig.stage.connect(rig.pump());
  CHECK(rig.stage.dynamics().min_speed_m_s == Approx(30.518 / 250e3).epsilon(1e-4));
  move_and_wait(rig, 0.2e-3, 0.05e-3);
  REQUIRE(rig.all<CommandedMove>().size() == 1);
  CHECK(rig.all<CommandedMove>()[0].move.speed_m_s == Approx(30.518 / 250e3).epsilon(1e-3));
  CHECK_FALSE(rig.has_event("move_doubtful", "test"));
  CHECK(stands_where_it_says(rig));
}

TEST_CASE("with fine steps GRBL moves no slower than 1 mm/min, and grblHAL at any speed",
          "[rig][pty]") {
  EmulatedRigOptions options = RigFixture::options();
  options.grbl.is_hal = GENERATE(false, true);
  RigFixture rig(options);
  rig.stage.connect(rig.pump());
  const double expected_m_s = options.grbl.is_hal ? 0.0 : 1e-3 / 60.0;
  CHECK(rig.stage.dynamics().min_speed_m_s == Approx(expected_m_s).margin(1e-12));
}

TEST_CASE("with soft limits a lift ends at the end of the controller's travel", "[rig][pty]") {
  EmulatedRigOptions options = RigFixture::options();
  options.grbl.soft_limit_mm = 3.0;
  RigFixture rig(options);
  rig.stage.connect(rig.pump());
  move_and_wait(rig, 0.2e-3, 1e-3);
  move_and_wait(rig, -0.5e-3, 1e-3);  // the unshortened move is refused: error 15
  CHECK(rig.stage.position_m() == Approx(0.0).margin(1e-9));
  CHECK(stands_where_it_says(rig));
  CHECK_THROWS_WITH(move_and_wait(rig, 3.1e-3, 1e-3), Contains("$130"));
  move_and_wait(rig, 0.1e-3, 1e-3);
  CHECK(stands_where_it_says(rig));
}

TEST_CASE("a stage outside of its own travel is refused with the advice to home it", "[rig]") {
  const StageDynamics dynamics{1600e3, 0.2, 5e-3, 0.0, 0.0, 3e-3};
  CHECK_THROWS_WITH(within_travel_m(-0.3e-3, 0.1e-3, dynamics, "$20"), Contains("home = true"));
  CHECK_THROWS_WITH(within_travel_m(3.1e-3, 3.0e-3, dynamics, "$20"), Contains("home = true"));
  CHECK(within_travel_m(0.0, 0.1e-3, dynamics, "$20") == 0.1e-3);
  // A limit between two steps: the lift ends on the step inside.
  const StageDynamics odd{1600e3, 0.2, 5e-3, 0.0, 0.3 / 1600e3, 3e-3};
  CHECK(within_travel_m(1e-3, -1e-3, odd, "$20") == Approx(1.0 / 1600e3).epsilon(1e-9));
}

TEST_CASE("a run with soft limits retracts as far as they allow and finishes", "[rig][pty]") {
  EmulatedRigOptions options = RigFixture::options();
  options.truth.surface_position_m = 0.1e-3;
  options.grbl.soft_limit_mm = 3.0;
  RigFixture rig(options);
  const RunOutcome outcome = rig.run(short_plan());
  INFO(outcome.reason);
  CHECK(outcome.status == "finished");
  CHECK(rig.emulated.outcome().final_position_m == Approx(0.0).margin(1e-6));
}

TEST_CASE("a question answered by two lines, or after the next question, ends no move early",
          "[rig][pty]") {
  EmulatedRigOptions options = RigFixture::options();
  SECTION("two lines") {
    options.grbl.reports_twice = true;
  }
  SECTION("350 ms late") {
    options.grbl.status_delay_s = 0.35;
  }
  SECTION("every third lost") {
    options.grbl.lose_status_every = 3;
  }
  RigFixture rig(options);
  rig.stage.connect(rig.pump());
  for (const double to_m : {0.3e-3, 0.1e-3, 0.4e-3}) {
    move_and_wait(rig, to_m, 0.5e-3);
    CHECK(stands_where_it_says(rig));
    CHECK(rig.stage.position_m() == Approx(to_m).margin(0.5 / 3200e3));
  }
  // The late reports must not contradict the moves.
  for (const CommandedMove& move : rig.all<CommandedMove>()) CHECK(move.start_uncertainty_s > 0.0);
  CHECK_FALSE(rig.has_event("move_doubtful", "test"));
}

TEST_CASE("a missing ok ends the move with an error that names it", "[rig][pty]") {
  EmulatedRigOptions options = RigFixture::options();
  options.grbl.lose_ok_number = 4;  // $$ and $$ of the connection, one jog, this jog
  RigFixture rig(options, std::nullopt, 0.2);
  rig.stage.connect(rig.pump());
  move_and_wait(rig, 0.1e-3, 1e-3);
  CHECK_THROWS_WITH(move_and_wait(rig, 0.2e-3, 1e-3), Contains("did not answer a move"));
  rig.stage.recover(rig.pump());
  move_and_wait(rig, 0.15e-3, 1e-3);
  CHECK(stands_where_it_says(rig));
}

TEST_CASE("a refused jog ends with the reason, and the next one works", "[rig][pty]") {
  EmulatedRigOptions options = RigFixture::options();
  options.grbl.refuse_jog_number = 2;
  RigFixture rig(options);
  rig.stage.connect(rig.pump());
  move_and_wait(rig, 0.1e-3, 1e-3);
  CHECK_THROWS_WITH(move_and_wait(rig, 0.2e-3, 1e-3), Contains("error 15"));
  CHECK_FALSE(rig.stage.is_moving());
  move_and_wait(rig, 0.15e-3, 1e-3);
  CHECK(stands_where_it_says(rig));
}

TEST_CASE("a line that is kept back at Idle is answered after a resume", "[rig][pty]") {
  EmulatedRigOptions options = RigFixture::options();
  options.grbl.holds_after_cancel = true;
  RigFixture rig(options);
  rig.stage.connect(rig.pump());
  rig.stage.begin_move(1e-3, 0.5e-3, "test");
  pump_for(rig, 0.2);
  rig.stage.stop_soft();
  while (rig.stage.is_moving()) pump_for(rig, 0.01);
  move_and_wait(rig, 0.05e-3, 1e-3);
  CHECK(rig.has_event("stage_nudged", ""));
  CHECK(stands_where_it_says(rig));
}

TEST_CASE("a hold button pressed at rest is an error when a move is asked for", "[rig][pty]") {
  RigFixture rig(RigFixture::options());
  rig.stage.connect(rig.pump());
  rig.stage_line.write("!", 0.5);
  pump_for(rig, 0.05);
  CHECK_THROWS_WITH(move_and_wait(rig, 0.1e-3, 1e-3), Contains("'Hold'"));
  rig.stage.recover(rig.pump());
  CHECK(rig.stage.state() == "Idle");
}

TEST_CASE("a stage that reports Jog for ever is given up", "[rig][pty]") {
  EmulatedRigOptions options = RigFixture::options();
  options.grbl.never_rests = true;
  RigFixture rig(options, std::nullopt, 0.2);
  rig.stage.connect(rig.pump());
  CHECK_THROWS_WITH(move_and_wait(rig, 0.1e-3, 1e-3), Contains("should have come to rest"));
}

TEST_CASE("a stage sent to a wrong position by a garbled line is stopped at once", "[rig][pty]") {
  EmulatedRigOptions options = RigFixture::options();
  options.grbl.misread_jog_number = 1;
  RigFixture rig(options);
  rig.stage.connect(rig.pump());
  CHECK_THROWS_WITH(move_and_wait(rig, 0.05e-3, 0.2e-3), Contains("outside of its path"));
  rig.stage.recover(rig.pump());
  CHECK(rig.emulated.outcome().final_position_m < 0.3e-3);  // of the 1.05 mm that it understood
  CHECK(stands_where_it_says(rig));
}

TEST_CASE("a stage slower than its settings is waited for, and the move is marked as doubtful",
          "[rig][pty]") {
  EmulatedRigOptions options = RigFixture::options();
  options.grbl.true_speed = GENERATE(1.0, 0.4);
  RigFixture rig(options);
  rig.stage.connect(rig.pump());
  move_and_wait(rig, 0.5e-3, 0.25e-3);
  CHECK(stands_where_it_says(rig));
  CHECK(rig.has_event("move_doubtful", "test") == (options.grbl.true_speed < 1.0));
}

TEST_CASE("a limit switch that raises another alarm when it opens still ends with the punch lifted",
          "[rig][pty]") {
  EmulatedRigOptions options = RigFixture::options();
  options.grbl.alarms_again = true;
  RigFixture rig(options);
  rig.sink = [&rig](const RunRecord& record) {
    rig.records.push_back(record);
    const auto* event = std::get_if<RunEvent>(&record);
    if (event != nullptr && event->value == "ramp") rig.emulated.cause(Incident::kHitLimitSwitch);
  };
  const RunOutcome outcome = rig.run(short_plan());
  INFO(outcome.reason);
  CHECK(outcome.status == "interrupted");
  CHECK_THAT(outcome.reason, Contains("alarm 1") && !Contains("And:"));
  CHECK(rig.emulated.outcome().final_position_m < demo_truth(10.0, 7).surface_position_m);
}

TEST_CASE("a stage that refuses to be unlocked ends with an error that names the refusal",
          "[rig][pty]") {
  EmulatedRigOptions options = RigFixture::options();
  options.grbl.is_homing_enabled = true;
  options.grbl.refuses_unlock = true;
  RigFixture rig(options);
  CHECK_THROWS_WITH(rig.stage.connect(rig.pump()), Contains("refused '$X'") && Contains("door"));
}

TEST_CASE("a board that resets late, while its settings are read, is asked again", "[rig][pty]") {
  RigFixture rig(RigFixture::options());
  bool has_restarted = false;
  const Pump pump = rig.pump();
  rig.stage.connect([&] {
    pump();
    if (!has_restarted && rig.all<StageReport>().size() == 1) {
      rig.emulated.cause(Incident::kRestartStage);
      has_restarted = true;
    }
  });
  REQUIRE(has_restarted);
  CHECK(rig.stage.dynamics().steps_per_m == Approx(3200e3).epsilon(1e-12));
  move_and_wait(rig, 0.1e-3, 1e-3);
  CHECK(stands_where_it_says(rig));
}

TEST_CASE("with coarse steps the record has the true position of the stage", "[rig][pty]") {
  EmulatedRigOptions options = RigFixture::options();
  options.truth.steps_per_m = 250e3;
  RigFixture rig(options);
  rig.stage.connect(rig.pump());
  move_and_wait(rig, 0.25e-3, 1e-3);
  REQUIRE(rig.all<CommandedMove>().size() == 1);
  CHECK(rig.all<CommandedMove>()[0].move.to_m == Approx(0.252e-3).epsilon(1e-9));  // 63 steps
  CHECK(rig.emulated.outcome().final_position_m == Approx(0.252e-3).epsilon(1e-9));
}

TEST_CASE("a stage that rests at another position than its target is an error", "[rig][pty]") {
  EmulatedRigOptions options = RigFixture::options();
  options.grbl.ends_short_number = 1;
  RigFixture rig(options);
  rig.stage.connect(rig.pump());
  CHECK_THROWS_WITH(move_and_wait(rig, 0.3e-3, 1e-3), Contains("did not reach 0.3000 mm"));
}

TEST_CASE("a force that stays flat at full depth is a doubt: steps may be lost", "[rig][pty]") {
  EmulatedRigOptions options = RigFixture::options();
  options.truth.material.E0_Pa *= 0.05;  // the force looks as it does after lost steps
  RigFixture rig(options);
  const RunOutcome outcome = rig.run(short_plan());
  INFO(outcome.reason);
  REQUIRE(outcome.status == "finished");
  REQUIRE(outcome.doubts.size() == 1);
  CHECK_THAT(outcome.doubts[0], Contains("lose steps"));
  CHECK(rig.has_event("doubt", "force_flat"));
}

TEST_CASE("after a restart of the controller under load the punch is lifted from the new zero",
          "[rig][pty]") {
  RigFixture rig(RigFixture::options());
  rig.sink = [&rig](const RunRecord& record) {
    rig.records.push_back(record);
    const auto* event = std::get_if<RunEvent>(&record);
    if (event != nullptr && event->value == "hold") rig.emulated.cause(Incident::kRestartStage);
  };
  const RunOutcome outcome = rig.run(short_plan());
  INFO(outcome.reason);
  CHECK(outcome.status == "interrupted");
  CHECK_THAT(outcome.reason, Contains("restarted") && !Contains("And:"));
  CHECK_THAT(outcome.reason, Contains("lifted by") && Contains("position is not known"));
  CHECK(outcome.code == "device-restarted");
  CHECK_FALSE(rig.emulated.outcome().is_moving);
  CHECK(rig.emulated.outcome().final_position_m < demo_truth(10.0, 7).surface_position_m);
}

}  // namespace viscard
