#include "rig/run/test_run.h"

#include "models/maths/text_of_number.h"

#include <algorithm>
#include <cmath>

namespace viscard {
namespace {

constexpr double kLiftMean_s = 0.25;
constexpr double kLiftMeanReadings = 8.0;
constexpr double kZeroDrift = 0.02;    // of the peak force: creep and hysteresis of a cell
constexpr double kHardlyFallen = 0.5;  // of the force before the lift
constexpr double kEarlyDrift = 0.2;    // of the contact threshold, soon after the tare

}  // namespace

double limit_N(const TestRun& run) {
  return run.rig.safety.soft_fraction * run.rig.calibration.capacity_N;
}

double live_depth_m(TestRun& run) {
  const double frame_N_m = run.rig.frame.stiffness_N_m;
  return run.session.stage().position_m() - run.contact_m -
         (frame_N_m > 0.0 ? run.session.force_N() / frame_N_m : 0.0);
}

void note_depth(TestRun& run) {
  run.outcome.achieved_depth_m = std::max(run.outcome.achieved_depth_m, live_depth_m(run));
}

double zero_drift_N(const TestRun& run) {
  const double share = run.outcome.contact_position_m ? 1.0 : kEarlyDrift;
  return share * run.plan.contact_force_N + kZeroDrift * run.session.peak_force_N();
}

double lift_mean_s(const TestRun& run) {
  return std::max(kLiftMean_s, kLiftMeanReadings * run.session.load_cell().period_s());
}

bool check_lifted(TestRun& run, double before_N, LiftEnd when) {
  RunSession& session = run.session;
  const ForceMean after = session.mean_force(lift_mean_s(run));
  const double allowed_N = zero_drift_N(run) + felt_difference_N(run.outcome.noise_N, after.n);
  const double rest_N = after.force_N;
  if (std::abs(rest_N) <= allowed_N) return true;
  const bool is_now = when == LiftEnd::kNow;
  const std::string text = (is_now ? "after the lift the force is "
                                   : "after the lift the punch was free, and now the force is ") +
                           text_from_number(rest_N, 3) + " N and not the zero of the tare within " +
                           text_from_number(allowed_N, 3) + " N";
  const std::string place =
      "; by the stage's count the punch is " +
      text_from_number((run.contact_m - session.stage().position_m()) * 1e3, 3) +
      " mm above the contact";
  // A punch that presses makes no negative force.
  const double hardly_N =
      std::max(kHardlyFallen * std::abs(before_N), is_now ? 0.0 : session.most_rise_N());
  if (rest_N > hardly_N) {
    run.is_place_doubtful = true;
    throw PunchNotFree("THE PUNCH MAY STILL PRESS: " + text + place + ". Lift it by hand. Either " +
                       (is_now ? "the motor does not turn (supply, cable, enable input of its "
                                 "driver), or the load cell does not measure"
                               : "the axis sinks (its weight, a motor without a holding current), "
                                 "something touched the cell, or its zero has jumped"));
  }
  run.outcome.doubts.insert(
      run.outcome.doubts.begin(),
      text + place +
          (rest_N > 0.0 ? ". Look whether it is free of the specimen; otherwise the "
                          "zero has drifted, and the forces of this run with it"
                        : ". The zero has moved by that, and the forces of this run "
                          "with it: the amplifier, an open wire of the load cell; or "
                          "the specimen pulls at the punch"));
  session.event("doubt", "after_lift", run.outcome.doubts.front());
  return false;
}

ContactEstimate contact_from_stops(const JogEnd& before, const JogEnd& touched, double noise_N,
                                   double step_m, double guess_N_m) {
  constexpr double kFeltSigmas = 6.0;
  const double felt_N = kFeltSigmas * noise_N;
  const double way_m = touched.position_m - before.position_m;
  ContactEstimate estimate;
  estimate.position_m = touched.position_m - touched.force_N / guess_N_m;
  if (!(way_m > 0.0)) return estimate;
  const bool was_felt = before.force_N > felt_N;
  const double rise_N = touched.force_N - (was_felt ? before.force_N : 0.0);
  estimate.least_stiffness_N_m = std::max(0.0, rise_N - felt_N) / (way_m + step_m);
  if (!was_felt) {
    estimate.position_m = std::max(estimate.position_m, before.position_m);
  } else if (rise_N > felt_N) {
    estimate.stiffness_N_m = rise_N / way_m;
    estimate.position_m = touched.position_m - touched.force_N / estimate.stiffness_N_m;
  }
  return estimate;
}

}  // namespace viscard
