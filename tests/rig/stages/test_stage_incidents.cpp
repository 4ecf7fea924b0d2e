// What every stage driver does alike when something happens: a limit switch, a cut supply, a pulled
// cable or a disturbed line leaves neither a moving stage nor an unreported pressing punch.
#include "tests/rig/stages/stage_rig.h"

#include <cstdint>
#include <map>
#include <string>

namespace viscard {
namespace {

using Catch::Matchers::Contains;

// A run in which something happens to the stage while it makes the ramp.
RunOutcome run_with(DeviceFixture& rig, Incident incident) {
  bool is_due = false;
  rig.sink = [&](const RunRecord& record) {
    rig.records.push_back(record);
    const auto* event = std::get_if<RunEvent>(&record);
    if (event != nullptr && event->name == "phase" && event->value == "ramp") is_due = true;
    if (!is_due || !rig.emulated.outcome().is_moving) return;
    is_due = false;
    rig.emulated.cause(incident);
  };
  return rig.run(shortest_stage_plan());
}

// Faults of the stage's line alone; those of the cell's line are tested elsewhere.
LineFaults stage_faults(std::uint64_t seed, bool is_garbled) {
  LineFaults faults = faults_of(seed);
  faults.cell = {};
  if (is_garbled) return faults;
  for (FaultRates* rates : {&faults.stage.to_host, &faults.stage.to_device}) {
    rates->garble = rates->insert = rates->hang_up = 0.0;
  }
  return faults;
}

// Waits until a move that nobody could stop has ended by itself.
EmulatedOutcome bench_at_the_end(DeviceFixture& rig) {
  const double until_s = rig.clock.awake_s() + 40.0;
  while (rig.emulated.outcome().is_moving && rig.clock.awake_s() < until_s) {
    wait_readable({}, rig.clock, 0.005);
  }
  return rig.emulated.outcome();
}

// One run; how it ended.
std::string run_over_disturbed_line(const std::string& driver, std::uint64_t seed,
                                    bool is_garbled) {
  const EmulatedRigOptions options = near_stage_rig(driver);
  DeviceFixture rig(options, stage_faults(seed, is_garbled));
  RunOutcome outcome;
  try {
    outcome = rig.run(shortest_stage_plan());
  } catch (const RigError& error) {  // before anything moved
    outcome.status = "refused";
    outcome.reason = error.what();
  }
  INFO(driver << ", seed " << seed << ", " << outcome.status << ": " << outcome.reason);
  const EmulatedOutcome bench = bench_at_the_end(rig);
  CHECK_FALSE(bench.is_moving);
  CHECK_FALSE(bench.is_cell_broken);
  CHECK(bench.peak_force_N < 0.9 * rig.config.calibration.capacity_N);
  const bool is_left_to_a_person = outcome.reason.find("by hand") != std::string::npos ||
                                   outcome.reason.find("And: ") != std::string::npos;
  if (!is_left_to_a_person) CHECK(bench.final_position_m < options.truth.surface_position_m);
  if (outcome.status == "finished") {
    CHECK(outcome.achieved_depth_m == Approx(0.13e-3).margin(6e-6));
  } else {
    CHECK(outcome.reason.size() > 20);
  }
  return outcome.status;
}

void run_disturbed_seeds(const std::string& driver, std::uint64_t last, bool is_garbled) {
  std::map<std::string, int> n;
  for (std::uint64_t seed = 1; seed <= last; ++seed) {
    ++n[run_over_disturbed_line(driver, seed, is_garbled)];
  }
  INFO(driver << ": " << n["finished"] << " finished, " << n["refused"] << " refused");
  CHECK(n["finished"] > static_cast<int>(last) / 4);
}

}  // namespace

TEST_CASE("a stage at a limit switch raises an alarm and recovers", "[rig][pty]") {
  const std::string driver = each_stage();
  INFO(driver);
  DeviceFixture rig(stage_rig(driver));
  Stage& stage = *rig.devices.stage;
  stage.connect(rig.pump());
  stage.begin_move(2e-3, 0.5e-3, "approach");
  pump_into_move(rig, 0.3);
  rig.emulated.cause(Incident::kHitLimitSwitch);
  CHECK_THROWS_AS(rig.pump_for(4.0), StageAlarm);
  stage.recover(rig.pump());
  CHECK(rig.move(0.0, 2e-3));
}

TEST_CASE("a run whose stage meets a limit switch lifts the punch", "[rig][pty]") {
  const std::string driver = each_stage();
  DeviceFixture rig(near_stage_rig(driver));
  const RunOutcome outcome = run_with(rig, Incident::kHitLimitSwitch);
  INFO(driver << ": " << outcome.reason);
  CHECK(outcome.status == "interrupted");
  CHECK(rig.emulated.outcome().final_position_m < 0.1e-3);
}

TEST_CASE("a cut of the supply of a stage is noticed, and the punch can be lifted afterwards",
          "[rig][pty]") {
  const std::string driver = each_stage();
  const bool is_moving = GENERATE(false, true);
  INFO(driver << (is_moving ? ", moving" : ", at rest"));
  EmulatedRigOptions options = stage_rig(driver);
  lose_power(options);
  DeviceFixture rig(options);
  Stage& stage = *rig.devices.stage;
  stage.connect(rig.pump());
  REQUIRE(rig.move(0.5e-3, 1e-3));
  if (is_moving) {
    stage.begin_move(0.9e-3, 0.1e-3, "ramp");
    pump_into_move(rig, 0.3);
  }
  rig.emulated.cause(Incident::kRestartStage);
  CHECK_THROWS_AS(rig.pump_for(2.0), DeviceRestarted);
  if (driver == "smc100") {  // it refuses every move without a reference
    CHECK_THROWS_WITH(stage.recover(rig.pump()), Contains("BY HAND"));
    return;
  }
  stage.recover(rig.pump());
  const double before_m = rig.emulated.outcome().final_position_m;
  REQUIRE(rig.move(stage.position_m() - 0.4e-3, 0.2e-3));
  CHECK(rig.emulated.outcome().final_position_m == Approx(before_m - 0.4e-3).margin(1e-7));
}

TEST_CASE("a run whose stage loses its supply lifts the punch or asks for it", "[rig][pty]") {
  const std::string driver = each_stage();
  EmulatedRigOptions options = near_stage_rig(driver);
  lose_power(options);
  DeviceFixture rig(options);
  const RunOutcome outcome = run_with(rig, Incident::kRestartStage);
  INFO(driver << ": " << outcome.reason);
  CHECK(outcome.status == "interrupted");
  CHECK_THAT(outcome.reason, Contains("supply"));
  if (driver == "smc100") {
    CHECK_THAT(outcome.reason, Contains("BY HAND"));
  } else {
    CHECK(rig.emulated.outcome().final_position_m < 0.1e-3);
  }
}

TEST_CASE("any stage whose cable was pulled is stopped when its port comes back", "[rig][pty]") {
  const std::string driver = each_stage();
  INFO(driver);
  EmulatedRigOptions options = stage_rig(driver);
  options.fault = rig_fault_from_text("stage-port-back@ramp");
  options.resets_on_open = false;
  DeviceFixture rig(options);
  Stage& stage = *rig.devices.stage;
  stage.connect(rig.pump());
  stage.begin_move(5e-3, 0.25e-3, "ramp");
  pump_into_move(rig, 0.2);
  rig.emulated.enter_phase("ramp");
  CHECK_THROWS_AS(rig.pump_for(2.0), PortHungUp);
  CHECK(rig.emulated.outcome().is_moving);
  const double until_s = rig.clock.now_s() + 3.0;
  while (!stage.transport().reopen() && rig.clock.now_s() < until_s) rig.clock.pass(0.1);
  stage.recover(rig.pump());
  CHECK_FALSE(rig.emulated.outcome().is_moving);
  CHECK(stage.position_m() < 2e-3);
  CHECK(rig.emulated.outcome().final_position_m == Approx(stage.position_m()).margin(0.6e-6));
  CHECK(rig.move(0.1e-3, 1e-3));
}

TEST_CASE("a run on any stage whose port comes back lifts the punch", "[rig][pty]") {
  const std::string driver = each_stage();
  const std::string phase = GENERATE("ramp", "hold");
  const bool is_back = GENERATE(true, false);
  EmulatedRigOptions options = near_stage_rig(driver);
  options.resets_on_open = GENERATE(true, false);
  options.fault = rig_fault_from_text((is_back ? "stage-port-back@" : "stage-port@") + phase);
  DeviceFixture rig(options);
  rig.sink = [&rig](const RunRecord& record) {
    rig.records.push_back(record);
    const auto* event = std::get_if<RunEvent>(&record);
    if (event != nullptr && event->name == "phase") rig.emulated.enter_phase(event->value);
  };
  const RunOutcome outcome = rig.run(shortest_stage_plan());
  INFO(driver << ", " << phase << ": " << outcome.reason);
  CHECK(outcome.status == "interrupted");
  CHECK((outcome.reason.find("by hand") != std::string::npos) == !is_back);
  if (!is_back) return;
  CHECK_FALSE(rig.emulated.outcome().is_moving);
  CHECK(rig.emulated.outcome().final_position_m < options.truth.surface_position_m);
}

TEST_CASE("runs over a disturbed line of any stage end well or give the reason",
          "[rig][pty][faults]") {
  const std::string driver = each_stage();
  const bool is_garbled = GENERATE(false, true);
  run_disturbed_seeds(driver, 6, is_garbled);
}

TEST_CASE("300 runs over a disturbed line of any stage end well or give the reason",
          "[rig][pty][faults][slow]") {
  const std::string driver = each_stage();
  run_disturbed_seeds(driver, 300, true);
}

}  // namespace viscard
