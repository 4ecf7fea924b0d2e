// What every stage driver does alike: the same test gives the same force, its record agrees with
// the motion, and a disturbed line leaves neither a moving stage nor an unreported pressing punch.
#include "tests/rig/device_fixture.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

namespace viscard {
namespace {

EmulatedRigOptions rig_with(const std::string& driver) {
  EmulatedRigOptions options = DeviceFixture::options(driver);
  options.truth.surface_position_m = 0.1e-3;
  if (driver != "apt") return options;
  options.truth.steps_per_m = 34304e3;
  options.truth.max_rate_m_s = 2.4e-3;
  options.truth.acceleration_m_s2 = 4e-3;
  return options;
}

TestPlan shortest_plan() {
  TestPlan plan;
  plan.approach_speed_m_s = 0.2e-3;
  plan.baseline_s = 0.5;
  plan.hold_s = 1.0;
  plan.recovery_s = 0.5;
  return plan;
}

LineFaults stage_faults(std::uint64_t seed, bool is_garbled) {
  LineFaults faults = faults_of(seed);
  faults.cell = {};
  for (FaultRates* rates : {&faults.stage.to_host, &faults.stage.to_device}) {
    rates->hang_up = 0.0;
    if (!is_garbled) rates->garble = rates->insert = 0.0;
  }
  return faults;
}

// Force over depth at the deepest point of a test.
double stiffness_N_m(const std::string& driver) {
  DeviceFixture rig(rig_with(driver));
  const RunOutcome outcome = rig.run(shortest_plan());
  INFO(driver << ": " << outcome.reason);
  REQUIRE(outcome.status == "finished");
  for (const RunEvent& event : rig.all<RunEvent>()) CHECK(event.name != "move_doubtful");
  return outcome.peak_force_N / outcome.achieved_depth_m;
}

}  // namespace

TEST_CASE("the same specimen is as stiff with every stage driver", "[rig][pty]") {
  const double with_grbl_N_m = stiffness_N_m("grbl");
  for (const char* driver : {"zaber", "apt", "marlin"}) {
    INFO(driver);
    // The live contact is found to a few um of 130.
    CHECK(stiffness_N_m(driver) == Approx(with_grbl_N_m).epsilon(0.03));
  }
}

TEST_CASE("the record of a move agrees with all reports of its positions", "[rig][pty]") {
  const std::string driver = GENERATE("grbl", "zaber", "apt", "marlin");
  const double speed_m_s = GENERATE(0.1e-3, 1e-3);
  DeviceFixture rig(rig_with(driver));
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
  const std::string driver = GENERATE("grbl", "zaber", "apt", "marlin");
  const bool is_hard = GENERATE(false, true);
  DeviceFixture rig(rig_with(driver));
  Stage& stage = *rig.devices.stage;
  stage.connect(rig.pump());
  for (const double after_s :
       {0.0, 0.001, 0.004, 0.008, 0.02, 0.05, 0.11, 0.3, 0.49, 0.505, 0.53}) {
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

TEST_CASE("a disturbed line to any stage leaves neither a moving stage nor a pressing punch",
          "[rig][pty]") {
  const std::string driver = GENERATE("zaber", "apt", "marlin");
  const bool is_garbled = GENERATE(false, true);
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const EmulatedRigOptions options = rig_with(driver);
    DeviceFixture rig(options, stage_faults(seed, is_garbled));
    const RunOutcome outcome = rig.run(shortest_plan());
    INFO(driver << " " << seed << ": " << outcome.status << ", " << outcome.reason);
    const EmulatedOutcome end = rig.emulated.outcome();
    CHECK_FALSE(end.is_cell_broken);
    if (outcome.reason.find("by hand") == std::string::npos) {
      CHECK_FALSE(end.is_moving);
      CHECK((!outcome.has_begun || end.final_position_m < options.truth.surface_position_m));
    }
    if (outcome.status == "finished") {
      CHECK(outcome.achieved_depth_m == Approx(0.13e-3).margin(6e-6));
    } else {
      CHECK_FALSE(outcome.reason.empty());
    }
  }
}

}  // namespace viscard
