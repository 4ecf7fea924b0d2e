// How a session watches that the load cell still measures, and that the force follows the stage.
#include "models/maths/text_of_number.h"
#include "rig/run/run_session.h"

#include <algorithm>
#include <cmath>

namespace viscard {
namespace {

constexpr double kJudgedShare = 0.01;   // of the capacity
constexpr double kJudgedSigmas = 12.0;  // of the noise of one reading
constexpr double kUnfollowed = 0.05;    // of the capacity: so much is implied when a move is judged
constexpr double kBlindRise = 0.10;     // of the capacity: the force may not rise by more unseen
constexpr double kRiseShare = 0.1;      // of the soft limit, in a move away from the specimen
constexpr std::int64_t kFewestEqual = 3;
constexpr double kChange_wall_s = 1.0;  // beyond the time of the longest stretch

struct TroubleWords {
  const char* value;  // of the event
  const char* what;
};

TroubleWords words_of(LifeWatch::Trouble trouble) {
  switch (trouble) {
    case LifeWatch::Trouble::kEqual:
      return {"frozen",
              "repeat one number, which their noise cannot do: the signal is frozen or in "
              "saturation"};
    case LifeWatch::Trouble::kQuiet:
      return {"quiet", "have lost their noise: what they show is no measurement any more"};
    case LifeWatch::Trouble::kWild:
      return {"wild", "have many times the noise of the tare: a wire of the load cell may be open"};
    case LifeWatch::Trouble::kFast:
      return {"rate",
              "come much faster than in the tare: the rate has jumped, so the lines are no "
              "longer single readings of the converter"};
    case LifeWatch::Trouble::kSlow:
      return {"rate",
              "come at less than half of the rate of the tare: their rate has dropped, and "
              "the force is seen too late"};
    case LifeWatch::Trouble::kNone:
      break;
  }
  return {"", ""};
}

}  // namespace

void RunSession::take_life(const LoadSample& sample, double made_at_s) {
  if (sample.is_glitch) return;
  if (sample.is_saturated) return life_.take_at_end();
  life_.take(received_value(sample), made_at_s);
  n_at_rest_ = devices_.is_stage_connected() && stage().is_moving() ? 0 : n_at_rest_ + 1;
  if (guards_force()) check_life();
}

// While the stage presses, the stretch of equal readings that is allowed ends before the force can
// have risen by a tenth of the capacity.
void RunSession::check_life() {
  if (!life_.is_watching()) return;
  const bool is_moving = stage().is_moving();
  const double rate_N_s = stiffness_N_m_ * press_speed_m_s_;
  std::int64_t most = 0;
  if (is_pressing_ && is_moving && rate_N_s > 0.0) {
    const double periods =
        kBlindRise * rig_.calibration.capacity_N / (rate_N_s * load_cell().period_s());
    most = std::max(kFewestEqual, static_cast<std::int64_t>(std::min(periods, 1e6)));
  }
  const bool is_settled = n_at_rest_ > static_cast<std::int64_t>(LifeWatch::kRecent);
  const LifeWatch::Trouble trouble = life_.judged(is_settled, most);
  if (trouble == LifeWatch::Trouble::kNone) return;
  if (trouble == LifeWatch::Trouble::kWild) return note_wild();
  end_blind(trouble);
}

// A shaken bench looks like that too, so a hold goes on; but nothing is pressed any further.
void RunSession::note_wild() {
  if (is_wild_) return;
  is_wild_ = true;
  const TroubleWords words = words_of(LifeWatch::Trouble::kWild);
  doubts_.push_back(std::string("the readings of the load cell ") + words.what +
                    ", or the bench was shaken");
  event("doubt", "noise_grown", doubts_.back());
}

void RunSession::end_blind(LifeWatch::Trouble trouble) {
  const TroubleWords words = words_of(trouble);
  const std::string where =
      trouble == LifeWatch::Trouble::kEqual && life_.newest() == 0.0 ? ", at exactly 0" : "";
  const bool was_moving = stage().is_moving();
  if (was_moving) devices_.stop_hard();
  is_pressing_ = false;
  blind_ = "does not measure any more";
  event("limit", words.value,
        std::string("The readings of the load cell ") + words.what + where +
            (was_moving ? ". The stage was reset" : ""));
  throw CellIsDead(std::string("the readings of the load cell ") + words.what + where +
                   ". Switch its amplifier off and on, check its wires, and check it with: viscard "
                   "rig check");
}

void RunSession::watch_hold(const std::string& phase, std::optional<double> rise_N) {
  held_phase_ = phase;
  constexpr double kFiltered_s = 0.6, kFilteredPeriods = 5.0;
  hold_.begin({.from_s = clock_.now_s(),
               .jump_N = judged_N(),
               .rise_N = rise_N,
               .settles_s = std::max(kFiltered_s, kFilteredPeriods * load_cell().period_s())});
}

void RunSession::take_hold(double force_N, double made_at_s) {
  const auto change = hold_.take(force_N, made_at_s);
  if (!change || has_hold_changed_) return;
  has_hold_changed_ = true;
  doubts_.push_back(
      "in the phase '" + held_phase_ + "' the force " +
      (change->is_jump ? "jumped by " : "rose by ") + text_from_number(change->by_N, 3) +
      (change->is_jump ? " N or more " : " N within ") + text_from_number(change->after_s, 2) +
      " s " + (change->is_jump ? "after the stage had come to rest" : "while the stage stood") +
      ", which no specimen does: the supply or a wire of the load cell failed, its gain or zero "
      "changed, something touched the rig, or the stage did not stand. Check these, then repeat "
      "the run");
  event("doubt", "hold_changed", doubts_.back());
}

// Before each move toward the specimen the readings must have changed since the last one began.
void RunSession::await_change() {
  if (!life_.is_watching()) return;
  if (is_wild_) {
    throw CellIsDead(doubts_.back() +
                     ". Nothing is pressed on a force that cannot be trusted: check the wires of "
                     "the load cell with: viscard rig check");
  }
  if (!life_.has_noise()) return;
  const double longest_wall_s = kChange_wall_s + static_cast<double>(life_.most_equal()) *
                                                     load_cell().period_s() / clock_.speed();
  if (!pump_while([&] { return life_.n_changes() == n_changes_before_; }, longest_wall_s)) {
    end_blind(LifeWatch::Trouble::kEqual);
  }
  n_changes_before_ = life_.n_changes();
}

double RunSession::implied_N(double from_m, double to_m) const {
  const auto pressed_m = [&](double at_m) { return std::max(0.0, at_m - follow_.contact_m); };
  return follow_.stiffness_N_m * (pressed_m(to_m) - pressed_m(from_m));
}

double RunSession::judged_N() const {
  return std::max(kJudgedSigmas * noise_N_, kJudgedShare * rig_.calibration.capacity_N);
}

double RunSession::most_rise_N() const {
  return std::max(kRiseShare * guard_.soft_limit_N(), judged_N());
}

// A cell that filters or delays its readings still shows the rise of a press that has just ended. The touch implies
// how far that can go: a specimen that relaxes bears less.
double RunSession::least_start_N() {
  constexpr double kFiltered_s = 1.0;
  if (clock_.now_s() > press_ended_s_ + kFiltered_s) return 0.0;
  return std::max(0.0, implied_N(follow_.contact_m, stage().position_m()));
}

void RunSession::end_wrong_way(double rise_N) {
  const bool was_moving = stage().is_moving();
  readings_.forget_rise();
  if (was_moving) devices_.stop_hard();
  event("limit", "away",
        "The force rose by " + text_from_number(rise_N * 1e3, 1) +
            " mN in a move away from the specimen" + (was_moving ? ": the stage was reset" : ""));
  throw StageGoesWrongWay(wrong_way_text(rise_N));
}

bool RunSession::follows(double implied_N, double change_N) const {
  return std::abs(implied_N) < judged_N() || change_N / implied_N >= kFollows;
}

void RunSession::check_follow() {
  if (!is_pressing_ || !stage().is_moving()) return;
  const double at_m = stage().position_m();
  if (places_.empty() || places_.back().position_m != at_m) {
    places_.push_back({clock_.now_s(), at_m});
  }
  // The place at which the newest reading was made, or an earlier one.
  while (places_.size() > 1 && places_[1].time_s <= readings_.newest_made_s()) places_.pop_front();
  if (places_.front().time_s > readings_.newest_made_s()) return;
  judge_press(places_.front().position_m);
  judge_rise(places_.front().position_m);
}

void RunSession::judge_rise(double position_m) {
  // Equal readings have a cause of their own.
  if (!is_pressing_ || (life_.has_noise() && life_.n_equal_now() > 0)) return;
  const auto stopped = rise_.take(position_m, readings_.sound_force_N(noise_N_));
  if (!stopped) return;
  if (stage().is_moving()) devices_.stop_hard();
  is_pressing_ = false;
  event("limit", "follow",
        "The force has risen no more for the last " +
            text_from_number((stopped->to_m - stopped->from_m) * 1e3, 3) + " mm of the press");
  throw_unfollowed("pressed on", stopped->from_m, stopped->to_m,
                   implied_N(stopped->from_m, stopped->to_m), stopped->rise_N);
}

void RunSession::judge_press(double position_m) {
  const double implied = implied_N(pressed_from_m_, position_m);
  if (implied < kUnfollowed * rig_.calibration.capacity_N) return;
  // Equal readings have a cause of their own, which is named a few readings later.
  if (life_.has_noise() && life_.n_equal_now() > 0) return;
  const double rise_N = readings_.sound_force_N(noise_N_) - pressed_from_N_;
  if (follows(implied, rise_N)) return;
  if (stage().is_moving()) devices_.stop_hard();
  is_pressing_ = false;
  event("limit", "follow",
        "The stage pressed by " + text_from_number((position_m - pressed_from_m_) * 1e3, 3) +
            " mm, the force changed by " + text_from_number(rise_N * 1e3, 1) + " mN");
  throw_unfollowed("pressed", pressed_from_m_, position_m, implied, rise_N);
}

void RunSession::throw_unfollowed(const std::string& what, double from_m, double to_m,
                                  double implied, double change_N) {
  throw ForceDoesNotFollow(
      "the force does not follow the stage: it " + what + " by " +
      text_from_number(std::abs(to_m - from_m) * 1e3, 3) + " mm by its count, for which the " +
      "stiffness of the contact implies " + text_from_number(implied * 1e3, 0) +
      " mN, and the force changed by " + text_from_number(change_N * 1e3, 1) +
      " mN. Either the motor does not turn (supply, cable, enable input of its driver), or the "
      "load cell does not measure (an open wire). Check both before the next run");
}

}  // namespace viscard
