#include "models/experiment/test_phases.h"

#include <catch2/catch.hpp>

#include <stdexcept>
#include <string>
#include <vector>

namespace viscard {
namespace {

using Catch::Matchers::Contains;

std::string names_of(const std::vector<TestPhase>& phases) {
  std::string names;
  for (const TestPhase& phase : phases) names += (names.empty() ? "" : " ") + phase.name;
  return names;
}

}  // namespace

TEST_CASE("ramp and hold keeps its list of phases", "[models]") {
  TestPlan plan;
  CHECK(names_of(phases_from_plan(plan)) ==
        "tare approach baseline ramp hold unload recovery retract baseline_after");
  plan.recovery_s = 0.0;
  plan.preload_N = 0.05;
  CHECK(names_of(phases_from_plan(plan)) ==
        "tare approach baseline preload preload_hold ramp hold retract baseline_after");
}

TEST_CASE("levels, cycles and stairs are numbered and reach their depths", "[models]") {
  TestPlan plan;
  plan.protocol = "levels";
  plan.levels = {{0.1e-3, 1.0, 5.0}, {0.2e-3, 1.0, 5.0}, {0.05e-3, 2.0, 5.0}};
  CHECK(
      names_of(phases_from_plan(plan)) ==
      "tare approach baseline ramp_1 hold_1 ramp_2 hold_2 unload_3 hold_3 retract baseline_after");
  CHECK(deepest_m(phases_from_plan(plan)) == 0.2e-3);
  plan.protocol = "cycles";
  plan.cycles = {.count = 2, .depth_m = 0.1e-3, .ramp_s = 2.0, .unload_to_fraction = 0.25};
  const auto cycles = phases_from_plan(plan);
  CHECK(names_of(cycles) ==
        "tare approach baseline load_1 unload_1 load_2 unload_2 retract baseline_after");
  CHECK(cycles[3].purpose == "ramp");  // the fit looks for the first
  CHECK(cycles[4].depth_m == Approx(0.025e-3).epsilon(1e-12));
  plan.protocol = "staircase";
  plan.staircase = {.steps = 2, .depth_m = 0.1e-3, .step_s = 0.5, .hold_s = 3.0};
  const auto stairs = phases_from_plan(plan);
  CHECK(names_of(stairs) ==
        "tare approach baseline step_1 hold_1 step_2 hold_2 step_3 hold_3 retract baseline_after");
  CHECK(stairs[3].depth_m == Approx(0.05e-3).epsilon(1e-12));
  CHECK(stairs[5].depth_m == Approx(0.1e-3).epsilon(1e-12));
  CHECK(stairs[7].depth_m == Approx(0.05e-3).epsilon(1e-12));
}

TEST_CASE("creep loads to its force and holds it", "[models]") {
  TestPlan plan;
  plan.protocol = "creep";
  plan.creep.force_N = 1.0;
  const auto phases = phases_from_plan(plan);
  CHECK(names_of(phases) == "tare approach baseline ramp creep retract baseline_after");
  CHECK(highest_force_N(phases) == 1.0);
  CHECK(phases[4].kind == TestPhase::Kind::kHoldForce);
  // tare 1, approach 7, baselines 2 x 10, ramp 1, creep 120, retract 1
  CHECK(planned_s(phases, 0, 7.0) == Approx(150.0).epsilon(1e-12));
}

TEST_CASE("a contradictory plan is refused with the key to change", "[models]") {
  TestPlan plan;
  plan.protocol = "lvels";
  CHECK_THROWS_WITH(phases_from_plan(plan), Contains("'lvels'") && Contains("staircase"));
  plan.protocol = "levels";
  CHECK_THROWS_WITH(phases_from_plan(plan), Contains("[[levels]]"));
  plan.levels = {{0.1e-3, 1.0, 1.0}, {0.1e-3, 1.0, 1.0}};
  CHECK_THROWS_WITH(phases_from_plan(plan), Contains("level 2"));
  plan.protocol = "creep";
  CHECK_THROWS_WITH(phases_from_plan(plan), Contains("[creep]"));
  plan.protocol = "cycles";
  CHECK_THROWS_WITH(phases_from_plan(plan), Contains("[cycles]"));
  plan.protocol = "staircase";
  CHECK_THROWS_WITH(phases_from_plan(plan), Contains("[staircase]"));
  plan.protocol = "ramp-hold";
  plan.gap_m = 0.0;
  CHECK_THROWS_AS(phases_from_plan(plan), std::invalid_argument);
}

}  // namespace viscard
