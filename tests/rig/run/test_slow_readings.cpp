// A converter of ten readings per second, as most cheap boards have.
#include "models/experiment/motion_profile.h"
#include "tests/rig/rig_fixture.h"

#include <catch2/catch.hpp>

#include <algorithm>

namespace viscard {
namespace {

EmulatedRigOptions slow_rig(double rate_Hz) {
  EmulatedRigOptions options = RigFixture::options();
  options.truth.sample_rate_Hz = rate_Hz;
  options.config.load_cell.expected_rate_Hz = rate_Hz;
  return options;
}

}  // namespace

TEST_CASE("with few readings per second a whole test runs, and ends as it does with eighty",
          "[rig][pty]") {
  const double rate_Hz = GENERATE(10.0, 5.0);
  CAPTURE(rate_Hz);
  RigFixture rig(slow_rig(rate_Hz));
  TestPlan plan = short_plan();
  plan.ramp_s = 10.0 / rate_Hz;
  const RunOutcome outcome = rig.run(plan);
  INFO(outcome.reason);
  REQUIRE(outcome.status == "finished");
  CHECK(outcome.doubts.empty());
  // Each step of the approach was sent after a reading made after the one before.
  const std::vector<CommandedMove> moves = rig.all<CommandedMove>();
  const std::vector<LoadSample> samples = rig.all<LoadSample>();
  int n_steps = 0;
  for (std::size_t i = 1; i < moves.size(); ++i) {
    if (moves[i].purpose != "approach" || moves[i - 1].purpose != "approach") continue;
    ++n_steps;
    CHECK(moves[i].move.to_m - moves[i].move.from_m < 26e-6);
    const double before_s = moves[i - 1].move.start_time_s + duration_s(moves[i - 1].move);
    CHECK(std::any_of(samples.begin(), samples.end(), [&](const LoadSample& sample) {
      return rig.load_cell.made_at_s(sample) > before_s &&
             sample.host_time_s < moves[i].move.start_time_s + 0.02;
    }));
  }
  CHECK(n_steps > 30);  // 1 mm
  CHECK(outcome.achieved_depth_m == Approx(plan.depth_m).margin(2e-6));
  CHECK(rig.emulated.outcome().peak_force_N < 0.95 * rig.config.calibration.capacity_N);
}

TEST_CASE("a specimen far stiffer than guessed does not overload a cell of ten readings per second",
          "[rig][pty]") {
  EmulatedRigOptions options = slow_rig(10.0);
  options.truth.material.E0_Pa *= 20.0;
  RigFixture rig(options);
  const RunOutcome outcome = rig.run(short_plan());
  INFO(outcome.reason);
  CHECK(outcome.status != "finished");
  CHECK(rig.emulated.outcome().peak_force_N < rig.config.calibration.capacity_N);
}

}  // namespace viscard
