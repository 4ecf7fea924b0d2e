#include "rig/run/expected_course.h"

#include "models/experiment/test_phases.h"

#include <algorithm>
#include <cmath>

namespace viscard {
namespace {

// Appends the corners of one phase after another.
class CourseLine {
 public:
  CourseLine(const Preflight& expected, ExpectedCourse& course)
      : expected_(expected), course_(course) {
    add_corner();
  }

  void add(const TestPhase& phase) {
    course_.phases.push_back({phase.name, phase.text, time_s_});
    const double before_m = depth_m_;
    switch (phase.kind) {
      case TestPhase::Kind::kMove:
        depth_m_ = phase.depth_m;
        break;
      case TestPhase::Kind::kLoad:
      case TestPhase::Kind::kHoldForce:
        depth_m_ = phase.force_N / expected_.specimen_stiffness_N_m;
        break;
      case TestPhase::Kind::kRetract:
        depth_m_ = 0.0;
        break;
      case TestPhase::Kind::kTare:
      case TestPhase::Kind::kApproach:
      case TestPhase::Kind::kWait:
        break;
    }
    const double way_m = std::abs(expected_.stage_travel_of(depth_m_ - before_m));
    const double move_s = phase.move_s > 0.0      ? phase.move_s
                          : phase.speed_m_s > 0.0 ? way_m / phase.speed_m_s
                                                  : 0.0;
    time_s_ += move_s;
    if (depth_m_ != before_m) add_corner();
    time_s_ += phase.duration_s;
    if (phase.duration_s > 0.0) add_corner();
  }

 private:
  void add_corner() {
    course_.time_s.push_back(time_s_);
    course_.depth_m.push_back(depth_m_);
    course_.force_N.push_back(expected_.specimen_stiffness_N_m * depth_m_);
  }

  const Preflight& expected_;
  ExpectedCourse& course_;
  double time_s_ = 0.0, depth_m_ = 0.0;
};

}  // namespace

ExpectedCourse expected_course(const TestPlan& plan, const Preflight& expected) {
  ExpectedCourse course;
  course.approach_at_most_s = plan.approach_limit_m / plan.approach_speed_m_s;
  CourseLine line(expected, course);
  for (const TestPhase& phase : phases_from_plan(plan)) {
    if (phase.kind == TestPhase::Kind::kTare) {
      course.approach_at_most_s += phase.duration_s;
    } else if (phase.kind != TestPhase::Kind::kApproach) {
      line.add(phase);
    }
  }
  return course;
}

}  // namespace viscard
