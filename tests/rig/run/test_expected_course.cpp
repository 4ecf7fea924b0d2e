#include "models/experiment/test_phases.h"
#include "rig/emulator/demo_rig.h"
#include "rig/run/expected_course.h"

#include <catch2/catch.hpp>

#include <algorithm>

namespace viscard {
namespace {

ExpectedCourse course_of(const TestPlan& plan) {
  return expected_course(plan, preflight(demo_rig(), plan, demo_specimen(10.0)));
}

TEST_CASE("the expected course of a ramp-hold test has its corners where the plan has them",
          "[rig]") {
  const TestPlan plan;
  const ExpectedCourse course = course_of(plan);
  const Preflight expected = preflight(demo_rig(), plan, demo_specimen(10.0));
  REQUIRE(course.time_s.size() == course.depth_m.size());
  REQUIRE(course.time_s.size() == course.force_N.size());
  CHECK(std::is_sorted(course.time_s.begin(), course.time_s.end()));
  const auto start_of = [&](const std::string& name) {
    for (const ExpectedCourse::Phase& phase : course.phases) {
      if (phase.name == name) return phase.start_s;
    }
    return -1.0;
  };
  CHECK(course.phases.front().name == "baseline");
  CHECK(start_of("ramp") == Approx(plan.baseline_s).epsilon(1e-12));
  CHECK(start_of("hold") == Approx(plan.baseline_s + plan.ramp_s).epsilon(1e-12));
  CHECK(start_of("unload") == Approx(plan.baseline_s + plan.ramp_s + plan.hold_s).epsilon(1e-12));
  CHECK(*std::max_element(course.depth_m.begin(), course.depth_m.end()) ==
        Approx(plan.depth_m).epsilon(1e-12));
  // The bound that the pre-flight check compares with the limit.
  CHECK(*std::max_element(course.force_N.begin(), course.force_N.end()) ==
        Approx(expected.peak_force_N).epsilon(1e-9));
  CHECK(course.depth_m.back() == 0.0);
  CHECK(course.approach_at_most_s > plan.approach_limit_m / plan.approach_speed_m_s);
}

TEST_CASE("the expected course of a creep test holds the force", "[rig]") {
  TestPlan plan;
  plan.protocol = "creep";
  plan.creep.force_N = 1.0;
  plan.creep.hold_s = 100.0;
  const ExpectedCourse course = course_of(plan);
  CHECK(*std::max_element(course.force_N.begin(), course.force_N.end()) ==
        Approx(1.0).epsilon(1e-9));
  CHECK(course.time_s.back() > 100.0);
}

}  // namespace
}  // namespace viscard
