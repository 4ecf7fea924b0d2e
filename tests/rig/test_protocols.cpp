#include "models/experiment/sample_force.h"
#include "rig/run/preflight.h"
#include "tests/rig/device_fixture.h"

#include <catch2/catch.hpp>

#include <algorithm>

namespace viscard {
namespace {

using Catch::Matchers::Contains;

TestPlan quick_plan(const std::string& protocol) {
  TestPlan plan;
  plan.protocol = protocol;
  plan.approach_speed_m_s = 0.2e-3;
  plan.baseline_s = 1.0;
  plan.recovery_s = 0.0;
  return plan;
}

struct Span {
  double from_s = 0.0, to_s = 0.0;
};

// The time from the event of a phase to the next phase event.
Span span_of(const DeviceFixture& rig, const std::string& phase) {
  Span span;
  for (const RunEvent& event : rig.all<RunEvent>()) {
    if (event.name != "phase") continue;
    if (span.from_s > 0.0) return {span.from_s, event.host_time_s};
    if (event.value == phase) span.from_s = event.host_time_s;
  }
  return span;
}

// Forces from the tare, of readings made within the span.
std::vector<double> forces_in(const DeviceFixture& rig, const Span& span) {
  std::vector<double> forces;
  for (const LoadSample& sample : rig.all<LoadSample>()) {
    const double made_s = rig.devices.load_cell->made_at_s(sample);
    if (made_s < span.from_s || made_s > span.to_s) continue;
    forces.push_back(*force_N_from_sample(sample, rig.config) - demo_truth(10.0, 7).force_offset_N);
  }
  return forces;
}

double mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

}  // namespace

TEST_CASE("creep holds its force within the tolerance without overshoot, even with a wrong guess",
          "[rig][pty]") {
  EmulatedRigOptions options = DeviceFixture::options();
  options.truth.material.E0_Pa *= GENERATE(0.6, 1.0, 1.4);
  DeviceFixture rig(options);
  TestPlan plan = quick_plan("creep");
  plan.creep = {.force_N = 0.8, .ramp_s = 1.0, .hold_s = 15.0, .tolerance_N = 4e-3};
  const RunOutcome outcome = rig.run(plan);
  INFO("E0 " << options.truth.material.E0_Pa << ": " << outcome.reason);
  REQUIRE(outcome.status == "finished");
  // Overshoot: a decelerating stop takes 60 ms, at this speed up to 4 % of the distance.
  CHECK(rig.emulated.outcome().peak_force_N < 1.05 * 0.8);
  Span creep = span_of(rig, "creep");
  creep.from_s += 3.0;
  const std::vector<double> forces = forces_in(rig, creep);
  REQUIRE(forces.size() > 800);
  CHECK(mean(forces) == Approx(0.8).margin(4e-3));  // the tolerance
  const auto [lowest, highest] = std::minmax_element(forces.begin(), forces.end());
  // Tolerance, relaxation between two steps, and 4 sigma of one reading.
  CHECK(*lowest > 0.8 - 4e-3 - 3e-3 - 4 * options.truth.force_noise_N);
  CHECK(*highest < 0.8 + 4e-3 + 3e-3 + 4 * options.truth.force_noise_N);
}

TEST_CASE("a creep beyond its depth limit ends the run and lifts the punch", "[rig][pty]") {
  EmulatedRigOptions options = DeviceFixture::options();
  options.truth.material.E0_Pa *= 0.5;
  DeviceFixture rig(options);
  TestPlan plan = quick_plan("creep");
  plan.creep = {.force_N = 0.8, .hold_s = 15.0, .depth_limit_m = 0.08e-3};
  const RunOutcome outcome = rig.run(plan);
  CHECK(outcome.status == "interrupted");
  CHECK_THAT(outcome.reason, Contains("depth_limit under [creep]"));
  CHECK(rig.emulated.outcome().final_position_m < options.truth.surface_position_m);
}

TEST_CASE("levels reach each depth in turn", "[rig][pty]") {
  DeviceFixture rig(DeviceFixture::options());
  TestPlan plan = quick_plan("levels");
  plan.levels = {{0.04e-3, 0.5, 2.0}, {0.1e-3, 0.5, 2.0}, {0.07e-3, 0.5, 2.0}};
  const RunOutcome outcome = rig.run(plan);
  INFO(outcome.reason);
  REQUIRE(outcome.status == "finished");
  const double first_N = mean(forces_in(rig, span_of(rig, "hold_1")));
  const double second_N = mean(forces_in(rig, span_of(rig, "hold_2")));
  const double third_N = mean(forces_in(rig, span_of(rig, "hold_3")));
  // Contact is known to 3 um; the force is linear in depth but for a few per cent of relaxation.
  CHECK(second_N / first_N == Approx(2.5).epsilon(0.1));
  CHECK(third_N / second_N == Approx(0.7).epsilon(0.06));
  CHECK(rig.emulated.outcome().peak_depth_m == Approx(0.1e-3).margin(4e-6));
}

TEST_CASE("cycles come back to the same depths", "[rig][pty]") {
  DeviceFixture rig(DeviceFixture::options());
  TestPlan plan = quick_plan("cycles");
  plan.cycles = {.count = 3, .depth_m = 0.1e-3, .ramp_s = 1.0, .hold_s = 0.5, .rest_s = 0.5};
  const RunOutcome outcome = rig.run(plan);
  INFO(outcome.reason);
  REQUIRE(outcome.status == "finished");
  std::vector<CommandedMove> moves;
  for (const CommandedMove& move : rig.all<CommandedMove>()) {
    if (move.purpose == "ramp" || move.purpose == "load" || move.purpose == "unload") {
      moves.push_back(move);
    }
  }
  REQUIRE(moves.size() == 6);
  CHECK(moves[0].purpose == "ramp");
  for (const std::size_t i : {2U, 4U}) {
    CHECK(moves[i].move.to_m == moves[0].move.to_m);
    CHECK(moves[i + 1].move.to_m == moves[1].move.to_m);
  }
}

TEST_CASE("a staircase holds on every step, up and down, after a preload", "[rig][pty]") {
  DeviceFixture rig(DeviceFixture::options());
  TestPlan plan = quick_plan("staircase");
  plan.staircase = {.steps = 3, .depth_m = 0.09e-3, .step_s = 0.5, .hold_s = 1.5};
  plan.preload_N = 0.05;
  plan.preload_s = 2.0;
  const RunOutcome outcome = rig.run(plan);
  INFO(outcome.reason);
  REQUIRE(outcome.status == "finished");
  CHECK(mean(forces_in(rig, span_of(rig, "preload_hold"))) == Approx(0.05).margin(5e-3));
  double before_N = 0.0;
  for (int step = 1; step <= 5; ++step) {
    const double force_N = mean(forces_in(rig, span_of(rig, "hold_" + std::to_string(step))));
    INFO("step " << step << ": " << force_N << " N");
    CHECK((force_N > before_N) == (step <= 3));
    before_N = force_N;
  }
}

TEST_CASE("the pre-flight check knows every protocol and names its key", "[rig]") {
  const StageDynamics fine{3200e3, 0.2, 10e-3};
  const auto problem = [&](const TestPlan& plan) {
    const Preflight result = preflight(demo_rig(), plan, demo_specimen(10.0), fine);
    return result.problems.empty() ? std::string() : result.problems.front();
  };
  TestPlan plan = quick_plan("levels");
  plan.levels = {{0.1e-3, 1.0, 1.0}, {0.3e-3, 1.0, 1.0}};
  CHECK_THAT(problem(plan), Contains("Lower depth of level 2 under [[levels]]"));
  plan.levels[1].depth_m = 0.12e-3;
  CHECK(problem(plan).empty());
  plan.levels[1].ramp_s = 1e-3;
  CHECK_THAT(problem(plan), Contains("Raise duration of level 2 under [[levels]]"));
  plan.protocol = "creep";
  plan.creep.force_N = 2.2;
  CHECK_THAT(problem(plan), Contains("Lower force under [creep] of the test file to 1.961 N"));
  plan.creep.force_N = 1.9;
  CHECK(problem(plan).empty());
  plan.protocol = "cycles";
  plan.cycles.depth_m = 0.3e-3;
  CHECK_THAT(problem(plan), Contains("Lower depth under [cycles]"));
  plan.protocol = "staircase";
  plan.staircase.depth_m = 0.3e-3;
  CHECK_THAT(problem(plan), Contains("Lower depth under [staircase]"));
}

}  // namespace viscard
