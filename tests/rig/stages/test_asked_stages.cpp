// What the drivers of controllers without numbered answers and checksums (PI, Newport) share.
#include "rig/stages/stage.h"
#include "tests/rig/device_fixture.h"

#include <catch2/catch.hpp>

#include <map>

namespace viscard {
namespace {

TestPlan shortest_asked_plan() {
  TestPlan plan;
  plan.approach_speed_m_s = 0.2e-3;
  plan.baseline_s = 0.5;
  plan.hold_s = 1.0;
  plan.recovery_s = 0.5;
  return plan;
}

EmulatedRigOptions asked_rig(const std::string& driver) {
  EmulatedRigOptions options = DeviceFixture::options(driver);
  options.truth.surface_position_m = 0.1e-3;
  return options;
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
  DeviceFixture rig(asked_rig(driver), stage_faults(seed));
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

TEST_CASE("runs over a disturbed line of the stage end well or give the reason",
          "[rig][pty][faults]") {
  const std::string driver = GENERATE("pi-gcs2");
  run_disturbed_seeds(driver, 1, 12);
}

TEST_CASE("300 runs over a disturbed line of the stage end well or give the reason",
          "[rig][pty][faults][slow]") {
  const std::string driver = GENERATE("pi-gcs2");
  run_disturbed_seeds(driver, 1, 300);
}

}  // namespace viscard
