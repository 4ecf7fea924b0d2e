#include "rig/run/force_phases.h"

#include "models/maths/text_of_number.h"
#include "rig/run/approach_phase.h"
#include "rig/run/force_control.h"
#include "rig/run/press_check.h"

#include <algorithm>
#include <cmath>

namespace viscard {
namespace {

constexpr double kNearShare = 0.45;    // of the force: from here on the stiffness is well known
constexpr double kFirstShare = 0.7;    // of the force: the first move, by the stiffness guessed
constexpr double kLeastRatio = 0.2;    // of the measured stiffness over the guessed one
constexpr double kMeanReadings = 8.0;  // of the mean before one step
constexpr double kLeastMean_s = 0.1;
constexpr double kTolerance = 0.005;   // of the force, unless the test file sets another
constexpr double kDeepestShare = 2.0;  // of the elastic depth: creep beyond that ends the run

// Long enough for a mean that a step can rely on.
double mean_s(TestRun& run) {
  return std::max(kLeastMean_s, kMeanReadings * run.session.load_cell().period_s());
}

ForceControl force_control(TestRun& run, const TestPhase& phase, double stiffness_N_m) {
  const CreepPlan& creep = run.plan.creep;
  const double noise_N = run.outcome.noise_N / std::sqrt(kMeanReadings);
  const double step_N = stiffness_N_m / run.session.stage().dynamics().steps_per_m;
  const double tolerance_N = creep.tolerance_N > 0.0 && phase.purpose == "creep"
                                 ? creep.tolerance_N
                                 : kTolerance * phase.force_N;
  return ForceControl({.target_N = phase.force_N,
                       .stiffness_N_m = stiffness_N_m,
                       .tolerance_N = std::max({tolerance_N, 3.0 * noise_N, 0.6 * step_N}),
                       .largest_step_m = kLongestJog_m,
                       .noise_N = noise_N});
}

void check_depth(TestRun& run, double deepest_m) {
  const double depth_m = live_depth_m(run);
  if (!(depth_m > deepest_m)) return;
  throw RigError("the specimen has crept to " + text_from_number(depth_m * 1e6, 1) +
                 " um, beyond the limit of " + text_from_number(deepest_m * 1e6, 1) +
                 " um, or the load cell shows too small a force (supply, wire, gain): check it. "
                 "Then lower force or set depth_limit under [creep] of the test file");
}

}  // namespace

void ForcePhases::load(const TestPhase& phase) {
  RunSession& session = run_.session;
  run_.is_in_contact = true;
  const double guess_N_m = run_.outcome.expected.total_stiffness_N_m;
  const double speed_m_s = phase.force_N / guess_N_m / phase.move_s;
  ForceMean reached = session.mean_force(mean_s(run_));
  if (reached.force_N < kNearShare * phase.force_N) {
    const double first_N = kFirstShare * phase.force_N;
    const double believed_N_m = measured_N_m_ > 0.0 ? measured_N_m_ : guess_N_m;
    session.move(run_.contact_m + first_N / believed_N_m, speed_m_s, phase.purpose, first_N);
    reached = session.mean_force(mean_s(run_));
  }
  const double way_m = session.stage().position_m() - run_.contact_m;
  measured_N_m_ = std::clamp(reached.force_N / std::max(way_m, 0.1 * run_.plan.gap_m),
                             kLeastRatio * guess_N_m, guess_N_m / kLeastRatio);
  check_way(run_, reached.force_N);
  const double rest_N = phase.force_N - reached.force_N;
  if (rest_N <= 0.0) return;
  session.move(session.stage().position_m() + rest_N / measured_N_m_, speed_m_s, phase.purpose,
               phase.force_N);
  note_depth(run_);
}

void ForcePhases::hold(const TestPhase& phase) {
  RunSession& session = run_.session;
  const double limit_m = run_.plan.creep.depth_limit_m;
  const double elastic_m = phase.force_N / run_.outcome.expected.specimen_stiffness_N_m;
  ForceControl control = force_control(run_, phase, measured_N_m_);
  const double end_s = session.stage().expected_end_s() + phase.duration_s;
  while (session.now_s() < end_s) {
    const double step_m = control.step_m(session.mean_force(mean_s(run_)).force_N);
    note_depth(run_);
    check_depth(run_, limit_m > 0.0 ? limit_m : kDeepestShare * elastic_m);
    if (step_m == 0.0) continue;
    session.move(session.stage().position_m() + step_m, run_.plan.approach_speed_m_s,
                 phase.purpose);
  }
}

}  // namespace viscard
