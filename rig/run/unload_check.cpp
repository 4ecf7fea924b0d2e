#include "rig/run/unload_check.h"

#include "models/maths/text_of_number.h"

#include <algorithm>
#include <cmath>

namespace viscard {
namespace {

constexpr double kContactError = 0.025;  // of the peak: the contact is known to some um
constexpr double kStillRelaxing = 0.3;   // of what has relaxed in the hold, until judge()
constexpr double kSeen_s = 0.5;
constexpr double kSeenPeriods = 5.0;
constexpr double kLeastPlay_m = 5e-6;
constexpr double kFewestStepsOfPlay = 4.0;  // of the motor

}  // namespace

void UnloadCheck::take_move(double from_m, double force_before_N, double took_s) {
  RunSession& session = run_.session;
  const double to_m = session.stage().position_m();
  least_N_.reset();
  if (to_m > from_m) {
    // Only a press from the contact: what earlier ones have left in the specimen is not known.
    const bool is_first = !press_ && from_m <= run_.contact_m;
    press_ = is_first ? std::optional(Press{to_m - run_.contact_m, session.peak_force_N(), took_s})
                      : std::optional(Press{});
    press_->ended_s = session.now_s();
    return;
  }
  if (!press_ || !(press_->way_m > 0.0) || to_m <= run_.contact_m) return;
  // The reading of the peak may have come after the end of the press.
  press_->peak_N = std::max(press_->peak_N, session.peak_force_N());
  unloaded_m_ = from_m - to_m;
  relaxed_N_ = std::max(0.0, press_->peak_N - force_before_N);
  // Of an unloading that follows at once the newest reading shows less than the force at its beginning.
  const double held_s = session.now_s() - took_s - press_->ended_s;
  const bool is_seen = held_s > kSeenPeriods * session.load_cell().period_s();
  before_N_ = is_seen ? force_before_N : std::max(force_before_N, press_->peak_N);
  least_N_ = force_before_N - unloaded_m_ / press_->way_m * press_->peak_N;
}

std::optional<double> UnloadCheck::due_after_s() const {
  if (!least_N_) return std::nullopt;
  return std::max(kSeen_s, 0.5 * press_->took_s);
}

void UnloadCheck::judge() {
  const double least_N = *least_N_;
  least_N_.reset();
  // A force that changed by itself in the hold before says nothing of the stage.
  if (run_.session.has_hold_changed()) return;
  const double force_N = run_.session.sound_force_N(run_.outcome.noise_N);
  if (least_N > 0.0) judge_lost_steps(least_N, force_N);
  judge_play(force_N);
}

void UnloadCheck::judge_lost_steps(double least_N, double force_N) {
  const double slack_N =
      kContactError * press_->peak_N + kStillRelaxing * relaxed_N_ + 6.0 * run_.outcome.noise_N;
  // No lost step makes the punch pull: the zero has moved, which the force after the lift shows.
  if (force_N >= least_N - slack_N || force_N < -zero_drift_N(run_)) return;
  const double stiffness_N_m = press_->peak_N / press_->way_m;
  run_.outcome.doubts.push_back(
      "the stage may have lost steps while it pressed: after an unloading by " +
      text_from_number(unloaded_m_ * 1e6, 1) + " um by its count the force is " +
      text_from_number(force_N * 1e3, 1) + " mN, where a stage that lost none leaves at least " +
      text_from_number(least_N * 1e3, 1) + " mN; the difference is " +
      text_from_number((least_N - force_N) / stiffness_N_m * 1e6, 1) +
      " um or more. Depth and modulus of this run are then wrong. Lower the speed or the "
      "acceleration, or raise the motor's current");
  run_.session.event("doubt", "lost_steps", run_.outcome.doubts.back());
}

void UnloadCheck::judge_play(double force_N) {
  const double most_N = before_N_ * (1.0 - unloaded_m_ / press_->way_m);
  const double step_m = 1.0 / run_.session.stage().dynamics().steps_per_m;
  const double stiffness_N_m = before_N_ / press_->way_m;
  const double contact_N = knows_stiffness(run_) ? 0.0 : kContactError * press_->peak_N;
  const double slack_N = stiffness_N_m * std::max(kLeastPlay_m, kFewestStepsOfPlay * step_m) +
                         contact_N + zero_drift_N(run_) + 6.0 * run_.outcome.noise_N;
  if (!(most_N > 0.0) || force_N <= most_N + slack_N) return;
  run_.outcome.doubts.push_back(
      "lost motion on reversal of some " +
      text_from_number((force_N - most_N) / stiffness_N_m * 1e6, 0) +
      " um: after an unloading by " + text_from_number(unloaded_m_ * 1e6, 1) +
      " um by the stage's count the force is " + text_from_number(force_N * 1e3, 1) +
      " mN, where it can be at most " + text_from_number(most_N * 1e3, 1) +
      " mN. The screw or its coupling has play, or the contact was found wrong because of that: "
      "contact, unloading and modulus are then wrong. Take the play out (preloaded nut, spring)");
  run_.session.event("doubt", "lost_motion", run_.outcome.doubts.back());
}

}  // namespace viscard
