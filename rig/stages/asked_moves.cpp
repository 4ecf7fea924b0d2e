// How AskedStage connects, begins, follows and ends a move, and recovers.
#include "models/maths/text_of_number.h"
#include "rig/stages/asked_stage.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace viscard {
namespace {

constexpr double kStandstill_wall_s = 10.0;
// A stage is outside of its path from here on; servos overshoot by less.
constexpr double kAstray_m = 5e-6;

}  // namespace

void AskedStage::connect(const Pump& pump) {
  if (!await_name(pump)) {
    throw_no_answer(
        dialect_.name + " of address " + std::to_string(config_.device), dialect_.settings,
        "Is this the stage's port, and is the controller switched on? " + dialect_.settings);
  }
  ask(dialect_.error_question, pump);  // an old error must not be taken for that of a command
  set_up(pump);
  await_rest(pump, kStandstill_wall_s);
  exact_m_ = reported_m_;
  start_m_ = reported_m_;
  is_recovering_ = false;
}

void AskedStage::recover(const Pump& pump) {
  is_recovering_ = true;
  polls_ = false;
  // A port that came back found the stage still moving.
  if (active_ && !active_->is_stopping) stop(dialect_.hard_stop);
  if (!await_name(pump)) {
    throw RigError("the stage on '" + transport_.name() +
                   "' does not answer: IT MAY STILL PRESS. Lift the punch by hand");
  }
  ask(dialect_.error_question, pump);
  await_rest(pump, kStandstill_wall_s);
  polls_ = false;
  set_free(pump);
  await_rest(pump, kStandstill_wall_s);
  if (active_) end_move(reported_m_);
  exact_m_ = reported_m_;
  n_unwell_ = 0;
  last_.trouble.clear();
  is_recovering_ = false;
}

void AskedStage::await_rest(const Pump& pump, double wall_s) {
  abort_round();
  polls_ = true;
  next_poll_s_ = clock_.now_s();
  const std::size_t before = n_rounds_;
  if (wait_for([&] { return n_rounds_ > before + 1 && last_.is_steady; }, pump, wall_s)) return;
  throw_no_rest();
}

void AskedStage::begin_move(double to_m, double speed_m_s, const std::string& purpose) {
  if (active_) throw RigError("a move was asked for while the stage was still moving");
  const double from_m = position_m();
  to_m =
      within_travel_m(from_m, quantised_m(to_m, dynamics_.steps_per_m), dynamics_, dialect_.limits);
  if (start_m_) check_travel(to_m, *start_m_, config_.travel_m);
  const double now_s = clock_.now_s();
  expected_end_s_ = now_s;
  if (std::abs(to_m - from_m) < 0.5 / dynamics_.steps_per_m) return;
  const double speed_mm_s = std::min(speed_m_s, dynamics_.max_speed_m_s) * 1e3;
  const StageMove move{now_s, from_m, to_m, speed_mm_s * 1e-3, dynamics_.acceleration_m_s2};
  validate(move);
  abort_round();
  last_.trouble.clear();
  active_ = ActiveMove{move, std::nullopt, purpose, to_m};
  expected_end_s_ = now_s + duration_s(move);
  jobs_.push_back({dialect_.error_question, Origin::kMove});  // old errors end here
  jobs_.push_back({speed_words(speed_mm_s), Origin::kMove});
  jobs_.push_back({dialect_.speed_question, Origin::kMove});
  jobs_.push_back({move_words(toward_ * to_m * 1e3 + 0.0), Origin::kMove, true});
  jobs_.push_back({dialect_.error_question, Origin::kMove});
  if (!dialect_.target_question.empty()) {
    jobs_.push_back({dialect_.target_question, Origin::kMove});
  }
  drive(now_s);
}

void AskedStage::take_move_answer(const std::string& question, const std::string& answer,
                                  double time_s) {
  if (!active_) return;
  if (question == dialect_.speed_question) {
    constexpr double kRounding = 0.01;
    const double wanted_mm_s = active_->planned.speed_m_s * 1e3;
    speed_mm_s_ = number_from_text(answer).value_or(0.0);
    if (std::abs(speed_mm_s_ - wanted_mm_s) > kRounding * wanted_mm_s) {
      jobs_.clear();
      active_.reset();
      throw RigError("the stage did not take the speed of " + text_of(wanted_mm_s) +
                     " mm/s; it reports " + answer);
    }
    active_->planned.speed_m_s = speed_mm_s_ * 1e-3;
    return;
  }
  if (question == dialect_.target_question) {
    const double target_mm = toward_ * number_from_text(answer).value_or(0.0);
    if (std::abs(target_mm * 1e-3 - active_->target_m) < 1.0 / dynamics_.steps_per_m) return;
    stop_hard();
    throw StageAlarm("the stage was sent to " + text_from_number(active_->target_m * 1e3, 4) +
                     " mm and understood " + text_from_number(target_mm, 4) +
                     " mm: it was stopped at once. Check its cable for interference, then start "
                     "the run again");
  }
  const std::string trouble = trouble_in(answer);
  if (!active_->tracker) {
    if (trouble.empty()) return;
    last_.trouble = trouble;
    note(time_s, "stage_warning", trouble, "The stage warns: " + trouble);
    return;
  }
  if (!trouble.empty()) {
    jobs_.clear();
    active_->refusal = trouble;  // a round will show why
    active_->tracker.reset();
    next_poll_s_ = time_s;
    return;
  }
  active_->accepted_s = time_s;
  active_->tracker->acknowledged(time_s);
  expected_end_s_ = active_->tracker->latest_end_s();
  next_poll_s_ = std::min(time_s + kPollMoving_s, expected_end_s_ + 2e-3);
}

void AskedStage::judge() {
  if (seen_.trouble.empty()) {
    seen_.trouble = last_.trouble;  // reading an error clears it in the controller
  } else if (seen_.trouble != last_.trouble) {
    note(seen_.asked_s, "stage_warning", seen_.trouble, "The stage warns: " + seen_.trouble);
  }
  seen_.is_steady = !seen_.is_moving && !last_.is_moving && n_rounds_ > 0 &&
                    std::abs(reported_m_ - last_m_) < 1.5 / dynamics_.steps_per_m;
  last_ = seen_;
  last_m_ = reported_m_;
  ++n_rounds_;
  if (!last_.is_moving && !last_.is_steady) next_poll_s_ = clock_.now_s();
  if (!is_recovering_) judge_health();
  if (active_) judge_move();
}

// No answer has a checksum, so a fault counts when two rounds in a row show it.
void AskedStage::judge_health() {
  const bool is_unwell = !last_.has_reference || !last_.holds;
  n_unwell_ = is_unwell ? n_unwell_ + 1 : 0;
  if (!is_unwell) return;
  if (n_unwell_ < 2) {
    next_poll_s_ = clock_.now_s();
    return;
  }
  if (!last_.has_reference) throw_reference_lost();
  exact_m_.reset();
  throw StageAlarm("the stage does not hold its position any more: " +
                   (last_.trouble.empty() ? "its motor is off" : last_.trouble));
}

void AskedStage::judge_move() {
  ActiveMove& active = *active_;
  if (active.is_stopping) {
    if (last_.asked_s < active.stop_s) return;
    if (last_.is_steady) return end_move(reported_m_);
    if (!last_.is_moving) return;
    // A stop that was lost is repeated, because it does no harm.
    const double due_s = active.stop_sent_s + clock_.from_wall_s(0.3) +
                         active.planned.speed_m_s / active.planned.acceleration_m_s2;
    if (clock_.now_s() > due_s) active.stop_sent_s = send(active.stop_words);
    return;
  }
  if (!active.refusal.empty()) {
    if (n_unwell_ > 0) return;
    const std::string refusal = active.refusal;
    active_.reset();
    exact_m_.reset();
    throw StageAlarm("the stage refused the move: " + refusal +
                     (last_.trouble.empty() ? "" : ", after " + last_.trouble));
  }
  watch_path(active.planned, kAstray_m, active.n_astray);
  if (last_.is_moving) {
    active.rests_since_s.reset();
    return;
  }
  if (!active.accepted_s || last_.asked_s < *active.accepted_s || n_unwell_ > 0) return;
  const double aside_m = std::abs(reported_m_ - active.target_m);
  if (last_.is_on_target && aside_m < 1.5 / dynamics_.steps_per_m) {
    return end_move(active.target_m);
  }
  if (last_.is_on_target && last_.is_steady && aside_m < kNear_m) return end_move(reported_m_);
  rest_elsewhere();
}

void AskedStage::rest_elsewhere() {
  constexpr double kSettling_wall_s = 1.0;
  ActiveMove& active = *active_;
  if (!active.rests_since_s) active.rests_since_s = last_.asked_s;
  if (last_.asked_s - *active.rests_since_s < clock_.from_wall_s(kSettling_wall_s)) {
    next_poll_s_ = std::min(next_poll_s_, clock_.now_s() + kPollMoving_s);
    return;
  }
  const double target_m = active.target_m;
  if (std::abs(reported_m_ - target_m) < kNear_m) {
    note(clock_.now_s(), "stage_off_target", text_of((reported_m_ - target_m) * 1e6, 3) + " um",
         "The stage rests beside its target and does not report that it has reached it");
    return end_move(reported_m_);
  }
  exact_m_.reset();
  if (!last_.trouble.empty()) {
    throw StageAlarm("the stage stopped at " + text_from_number(reported_m_ * 1e3, 4) +
                     " mm on its way to " + text_from_number(target_m * 1e3, 4) +
                     " mm: " + last_.trouble);
  }
  active_.reset();
  throw_elsewhere(target_m, "the controller reports no error", "an obstacle or a turned knob");
}

void AskedStage::end_move(double end_m) {
  const ActiveMove ended = *std::exchange(active_, std::nullopt);
  hand_out(ended.tracker, ended.purpose, end_m);
}

void AskedStage::stop(const std::string& words) {
  jobs_.clear();
  abort_round();
  const double sent_s = send(words);
  free_at_s_ = sent_s + clock_.from_wall_s(dialect_.after_command_wall_s);
  if (!active_) return;
  active_->is_stopping = true;
  active_->stop_words = words;
  active_->stop_s = active_->stop_sent_s = sent_s;
  next_poll_s_ = sent_s;
}

void AskedStage::stop_hard() {
  is_recovering_ = true;
  stop(dialect_.hard_stop);
}

}  // namespace viscard
