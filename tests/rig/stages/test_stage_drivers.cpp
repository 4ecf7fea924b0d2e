// What every stage driver does alike: the same test gives the same force, its record agrees with
// the motion, a stop leaves the stage where it says, and an error ends its homing.
#include "rig/lines/serial_line.h"
#include "rig/run/run_control.h"
#include "tests/rig/stages/stage_rig.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace viscard {
namespace {

// Force over depth at the deepest point of a test.
double stiffness_N_m(const std::string& driver) {
  DeviceFixture rig(near_stage_rig(driver));
  const RunOutcome outcome = rig.run(shortest_stage_plan());
  INFO(driver << ": " << outcome.reason);
  REQUIRE(outcome.status == "finished");
  CHECK(outcome.achieved_depth_m == Approx(0.13e-3).margin(4e-6));  // contact is found to a few um
  CHECK(rig.emulated.outcome().final_position_m < 0.1e-3);
  for (const RunEvent& event : rig.all<RunEvent>()) CHECK(event.name != "move_doubtful");
  return outcome.peak_force_N / outcome.achieved_depth_m;
}

}  // namespace

TEST_CASE("the same specimen is as stiff with every stage driver", "[rig][pty]") {
  const double with_grbl_N_m = stiffness_N_m("grbl");
  for (const char* driver : {"zaber", "apt", "marlin", "pi-gcs2", "smc100"}) {
    INFO(driver);
    // The live contact is found to a few um of 130.
    CHECK(stiffness_N_m(driver) == Approx(with_grbl_N_m).epsilon(0.03));
  }
}

TEST_CASE("the record of a move agrees with all reports of its positions", "[rig][pty]") {
  const std::string driver = each_stage();
  const double speed_m_s = GENERATE(0.1e-3, 1e-3);
  INFO(driver << ", " << speed_m_s * 1e3 << " mm/s");
  DeviceFixture rig(near_stage_rig(driver));
  Stage& stage = *rig.devices.stage;
  stage.connect(rig.pump());
  REQUIRE(rig.move(0.6e-3, speed_m_s));
  const CommandedMove made = rig.all<CommandedMove>().back();
  CHECK(made.start_uncertainty_s < 0.12);
  double farthest_m = 0.0;
  for (const StageReport& report : rig.all<StageReport>()) {
    if (report.host_time_s < made.move.start_time_s) continue;
    const double off_m = report.position_m - position_m(made.move, report.host_time_s);
    farthest_m = std::max(farthest_m, std::abs(off_m));
  }
  // GRBL reports whole um; a report is up to 10 ms old.
  CHECK(farthest_m < speed_m_s * (made.start_uncertainty_s + 0.010) + 2e-6);
}

TEST_CASE("a stage that is stopped at any moment of a move stands where it says", "[rig][pty]") {
  const std::string driver = each_stage();
  const bool is_hard = GENERATE(false, true);
  DeviceFixture rig(near_stage_rig(driver));
  Stage& stage = *rig.devices.stage;
  stage.connect(rig.pump());
  for (const double after_s :
       {0.0, 0.001, 0.004, 0.008, 0.02, 0.05, 0.11, 0.3, 0.49, 0.505, 0.53, 0.7}) {
    INFO(driver << (is_hard ? ", at once" : ", gently") << " after " << after_s << " s");
    const double from_m = stage.position_m();
    stage.begin_move(from_m + 0.25e-3, 0.5e-3, "press");
    rig.pump_for(after_s);
    if (is_hard) {
      stage.stop_hard();
      stage.recover(rig.pump());
    } else {
      stage.stop_soft();
      while (stage.is_moving()) rig.pump()();
    }
    rig.pump_for(0.5);
    CHECK_FALSE(rig.emulated.outcome().is_moving);
    // GRBL reports whole um.
    CHECK(rig.emulated.outcome().final_position_m == Approx(stage.position_m()).margin(0.6e-6));
    CHECK(stage.position_m() < from_m + 0.2501e-3);
    REQUIRE(rig.move(0.0, 2e-3));
    // Marlin makes no moves of fewer than 6 steps.
    CHECK(rig.emulated.outcome().final_position_m == Approx(0.0).margin(2e-6));
    CHECK(rig.emulated.outcome().final_position_m == Approx(stage.position_m()).margin(0.6e-6));
  }
}

TEST_CASE("a homing that Ctrl-C or a force limit interrupts is stopped at once", "[rig][pty]") {
  const std::string driver = GENERATE("zaber", "apt", "marlin", "pi-gcs2", "smc100");
  CAPTURE(driver);
  EmulatedRigOptions options = near_stage_rig(driver);
  lose_power(options);  // when the port is opened again: it has to be homed then
  EmulatedRig emulated(options);
  StageConfig config = emulated.config().stage;
  const RigClock clock = emulated.clock();
  for (const bool is_second : {false, true}) {
    wait_readable({}, clock, 0.5);  // so that the emulator sees the port closed
    config.home = is_second;
    SerialLine line(config.port, 115200, clock);
    const auto stage = make_stage(line, config, clock, [](const RunRecord&) {});
    const Pump pump = [&] {
      wait_readable({&line}, clock, 0.002);
      stage->service();
      if (is_second && emulated.outcome().is_moving) throw RunInterrupted("interrupted");
    };
    if (is_second) {
      CHECK_THROWS_AS(stage->connect(pump), RunInterrupted);
    } else {
      stage->connect(pump);
      stage->begin_move(-2e-3, 1e-3, "lift");
      while (stage->is_moving()) pump();
    }
    for (int i = 0; i < 10; ++i) clock.pass(0.1);
  }
  CHECK_FALSE(emulated.outcome().is_moving);
  CHECK(emulated.outcome().final_position_m < -1e-3);
}

}  // namespace viscard
