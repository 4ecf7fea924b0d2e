// What the drivers of controllers without numbered answers and checksums (PI, Newport) share.
#include "rig/stages/stage.h"
#include "tests/rig/device_fixture.h"
#include "tests/rig/stages/asked_rig.h"

#include <catch2/catch.hpp>

#include <map>

namespace viscard {
namespace {

using Catch::Matchers::Contains;

TestPlan shortest_asked_plan() {
  TestPlan plan;
  plan.approach_speed_m_s = 0.2e-3;
  plan.baseline_s = 0.5;
  plan.hold_s = 1.0;
  plan.recovery_s = 0.5;
  return plan;
}

TestPlan quick_asked_plan() {
  TestPlan plan = shortest_asked_plan();
  plan.baseline_s = 1.0;
  plan.hold_s = 2.0;
  plan.recovery_s = 1.0;
  return plan;
}

// Of each driver in turn.
EmulatedRigOptions asked_rig() {
  return DeviceFixture::options(GENERATE("pi-gcs2", "smc100"));
}

EmulatedRigOptions asked_rig_near(const std::string& driver) {
  EmulatedRigOptions options = DeviceFixture::options(driver);
  options.truth.surface_position_m = 0.1e-3;
  return options;
}

// A run in which something happens to the stage when the ramp begins.
RunOutcome run_with(DeviceFixture& rig, Incident incident) {
  bool has_happened = false;
  rig.sink = [&](const RunRecord& record) {
    rig.records.push_back(record);
    const auto* event = std::get_if<RunEvent>(&record);
    if (has_happened || event == nullptr || event->name != "phase") return;
    if (event->value != "ramp") return;
    has_happened = true;
    rig.emulated.cause(incident);
  };
  return rig.run(quick_asked_plan());
}

// Faults of the stage's line alone; those of the cell's line are tested elsewhere.
LineFaults stage_faults(std::uint64_t seed) {
  LineFaults faults = faults_of(seed);
  faults.cell = {};
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
std::string run_over_disturbed_line(const std::string& driver, std::uint64_t seed) {
  DeviceFixture rig(asked_rig_near(driver), stage_faults(seed));
  std::string status, reason;
  try {
    const RunOutcome outcome = rig.run(shortest_asked_plan());
    status = outcome.status;
    reason = outcome.reason;
  } catch (const RigError& error) {  // before anything moved
    status = "refused";
    reason = error.what();
  }
  INFO(driver << ", seed " << seed << ", " << status << ": " << reason);
  const EmulatedOutcome bench = bench_at_the_end(rig);
  CHECK_FALSE(bench.is_moving);
  CHECK_FALSE(bench.is_cell_broken);
  CHECK(bench.peak_force_N < 0.9 * rig.config.calibration.capacity_N);
  if (reason.find("by hand") == std::string::npos && reason.find("And: ") == std::string::npos) {
    CHECK(bench.final_position_m < 0.1e-3);
  }
  if (status != "finished") CHECK(reason.size() > 20);
  return status;
}

void run_disturbed_seeds(const std::string& driver, std::uint64_t first, std::uint64_t last) {
  std::map<std::string, int> n;
  for (std::uint64_t seed = first; seed <= last; ++seed) ++n[run_over_disturbed_line(driver, seed)];
  INFO(driver << ": " << n["finished"] << " finished, " << n["refused"] << " refused");
  CHECK(n["finished"] > static_cast<int>(last - first) / 4);
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

TEST_CASE("a PI or Newport stage stops gently or at once and can be moved again", "[rig][pty]") {
  EmulatedRigOptions options = asked_rig();
  answers_of(options).lose_every = GENERATE(0, 5);
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

TEST_CASE("a PI or Newport stage whose cable was pulled is stopped when its port comes back",
          "[rig][pty]") {
  EmulatedRigOptions options = asked_rig();
  options.fault = rig_fault_from_text("stage-port-back@ramp");
  options.resets_on_open = false;
  DeviceFixture rig(options);
  Stage& stage = *rig.devices.stage;
  stage.connect(rig.pump());
  stage.begin_move(5e-3, 0.5e-3, "ramp");
  pump_into_move(rig, 0.2);
  rig.emulated.enter_phase("ramp");
  CHECK_THROWS_AS(rig.pump_for(2.0), PortHungUp);
  CHECK(rig.emulated.outcome().is_moving);
  const double until_s = rig.clock.now_s() + 3.0;
  while (!stage.transport().reopen() && rig.clock.now_s() < until_s) rig.clock.pass(0.1);
  stage.recover(rig.pump());
  CHECK_FALSE(rig.emulated.outcome().is_moving);
  CHECK(stage.position_m() == Approx(rig.emulated.outcome().final_position_m).margin(1e-9));
  CHECK(rig.move(0.1e-3, 1e-3));
}

TEST_CASE("a whole test runs on a PI or Newport stage and presses with the force of its specimen",
          "[rig][pty]") {
  EmulatedRigOptions options = asked_rig();
  answers_of(options).late_every = GENERATE(0, 199);
  DeviceFixture rig(options);
  const RunOutcome outcome = rig.run(quick_asked_plan());
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

TEST_CASE("a run on a PI or Newport stage that meets a motion error lifts the punch",
          "[rig][pty]") {
  DeviceFixture rig(asked_rig());
  const RunOutcome outcome = run_with(rig, Incident::kHitLimitSwitch);
  INFO(outcome.reason);
  CHECK(outcome.status == "interrupted");
  CHECK_THAT(outcome.reason, Contains("could not follow"));
  CHECK(rig.emulated.outcome().final_position_m < demo_truth(10.0, 7).surface_position_m);
}

TEST_CASE("a run on a PI or Newport stage whose supply is cut lifts the punch or asks for it",
          "[rig][pty]") {
  EmulatedRigOptions options = asked_rig();
  options.pi.loses_power = options.smc.loses_power = true;
  DeviceFixture rig(options);
  const RunOutcome outcome = run_with(rig, Incident::kRestartStage);
  INFO(outcome.reason);
  CHECK(outcome.status == "interrupted");
  CHECK_THAT(outcome.reason, Contains("supply"));
  if (options.config.stage.driver == "smc100") {
    CHECK_THAT(outcome.reason, Contains("BY HAND"));
  } else {
    CHECK(rig.emulated.outcome().final_position_m < demo_truth(10.0, 7).surface_position_m);
  }
}

TEST_CASE("runs over a disturbed line of the stage end well or give the reason",
          "[rig][pty][faults]") {
  const std::string driver = GENERATE("pi-gcs2", "smc100");
  run_disturbed_seeds(driver, 1, 12);
}

TEST_CASE("300 runs over a disturbed line of the stage end well or give the reason",
          "[rig][pty][faults][slow]") {
  const std::string driver = GENERATE("pi-gcs2", "smc100");
  run_disturbed_seeds(driver, 1, 300);
}

}  // namespace viscard
