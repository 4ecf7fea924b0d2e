// A run that a person watches and stops without braking.
#include "tests/rig/rig_fixture.h"

#include <catch2/catch.hpp>

#include <atomic>
#include <string>

namespace viscard {
namespace {

TestPlan plan_with_hold(double hold_s) {
  TestPlan plan;
  plan.hold_s = hold_s;
  plan.recovery_s = 0.0;
  plan.baseline_s = 2.0;
  return plan;
}

RunOutcome run_with(RigFixture& rig, RunControl control, const TestPlan& plan) {
  control.clock = &rig.clock;
  control.stop = &rig.stop;
  return run_indentation(rig.stage, rig.load_cell, rig.config, plan, demo_specimen(10.0), rig.sink,
                         control);
}

TEST_CASE("a stop at once resets the stage in a move, then lifts the punch", "[rig][pty]") {
  const std::string phase = GENERATE("approach", "ramp", "hold");
  CAPTURE(phase);
  RigFixture rig(RigFixture::options());
  std::atomic<bool> stop_at_once{false};
  when_phase(rig, phase, [&] { stop_at_once = true; });
  TestPlan plan = plan_with_hold(600.0);
  plan.ramp_s = 5.0;
  RunControl control;
  control.stop_at_once = &stop_at_once;
  const RunOutcome outcome = run_with(rig, control, plan);
  CAPTURE(outcome.reason);
  CHECK(outcome.status == "interrupted");
  CHECK(outcome.reason.find("the run was stopped at once") == 0);
  CHECK(rig.has_event("limit", "person"));
  const EmulatedOutcome truth = rig.emulated.outcome();
  CHECK_FALSE(truth.is_moving);
  CHECK(truth.final_position_m < 1.0e-3);  // above the surface
}

TEST_CASE("a stop at once after a gentle stop ends every motion", "[rig][pty]") {
  RigFixture rig(RigFixture::on_wall_clock(1.0));
  std::atomic<bool> stop_at_once{false};
  int n_since_stop = 0;
  RunControl control;
  control.stop_at_once = &stop_at_once;
  control.progress = [&](const RunProgress& now) {
    if (now.phase == "approach") rig.stop = true;
    if (rig.stop && ++n_since_stop == 2) stop_at_once = true;  // brakes, or lifts already
  };
  const RunOutcome outcome = run_with(rig, control, plan_with_hold(1.0));
  CAPTURE(outcome.reason);
  CHECK(outcome.status == "interrupted");
  CHECK_FALSE(rig.emulated.outcome().is_moving);
  CHECK(rig.emulated.outcome().final_position_m < 1.0e-3);
  if (n_since_stop >= 2) CHECK(rig.has_event("limit", "person"));
}

TEST_CASE("every sound reading reaches the person watching, with time, force and depth",
          "[rig][pty]") {
  RigFixture rig(RigFixture::options());
  std::vector<RunReading> readings;
  RunControl control;
  control.reading = [&](const RunReading& reading) { readings.push_back(reading); };
  const RunOutcome outcome = run_with(rig, control, plan_with_hold(4.0));
  REQUIRE(outcome.status == "finished");
  CHECK(100 * readings.size() > 99 * rig.all<LoadSample>().size());
  double peak_N = 0.0, deepest_m = 0.0;
  for (std::size_t i = 0; i < readings.size(); ++i) {
    peak_N = std::max(peak_N, readings[i].force_N);
    deepest_m = std::max(deepest_m, readings[i].depth_m);
    if (i > 0) CHECK(readings[i].time_s > readings[i - 1].time_s);
  }
  CHECK(peak_N == Approx(outcome.peak_force_N).epsilon(0.01));
  CHECK(deepest_m == Approx(0.13e-3).margin(0.01e-3));
}

}  // namespace
}  // namespace viscard
