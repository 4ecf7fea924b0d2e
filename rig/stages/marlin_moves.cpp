// How MarlinStage begins, feeds, follows, stops and ends a move.
#include "models/maths/text_of_number.h"
#include "rig/stages/marlin_stage.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace viscard {
namespace {

constexpr double kPiece_m = 20e-6;
// Shorter pieces are slowed down (SLOWDOWN with a minimum segment time of 20 ms), and at high speed
// the next one would come too late.
constexpr double kPiece_s = 0.05;
constexpr double kOldReport_s = 0.3;
constexpr double kLastStep_wall_s = 0.01;
constexpr double kStill_wall_s = 0.5;
constexpr double kStillBetween_wall_s = 2.0;

}  // namespace

void MarlinStage::begin_move(double to_m, double speed_m_s, const std::string& purpose) {
  if (active_) throw RigError("a move was asked for while the stage was still moving");
  const StageDynamics limits = dynamics();
  const double from_m = metres(count_);
  const long long target = std::llround(toward_ * to_m * limits.steps_per_m);
  to_m = metres(target);
  if (start_m_) check_travel(to_m, *start_m_, config_.travel_m);
  const double now_s = clock_.now_s();
  expected_end_s_ = now_s;
  const long long way = std::llabs(target - count_);
  if (way == 0) return;
  // Not below the smallest speed, so that the record states the true speed.
  const double held_m_s = std::max(std::min(speed_m_s, limits.max_speed_m_s), limits.min_speed_m_s);
  const double feed_mm_min = std::round(held_m_s * 60e6) * 1e-3;
  const StageMove move{now_s, from_m, to_m, feed_mm_min / 60e3, limits.acceleration_m_s2};
  validate(move);
  long long n_pieces = 1;
  if (to_m > from_m) {
    const double most = std::max(kPiece_m, move.speed_m_s * kPiece_s) * limits.steps_per_m;
    n_pieces = std::llround(std::ceil(static_cast<double>(way) / most));
    n_pieces = std::max(1LL, std::min(n_pieces, way / kFewestSteps));
  }
  active_ = ActiveMove{move, feed_mm_min, count_, target, (way + n_pieces - 1) / n_pieces, purpose};
  active_->seen = count_;
  active_->late_before_s = clock_.late_s();
  last_message_.clear();
  expected_end_s_ = now_s + duration_s(move);
  next_poll_s_ = now_s + kPiece_s;
  drive(now_s);
}

// One piece is being made and two wait, by the plan and about so by the last report. Each begins
// while the next one is known, so the planner does not brake between them.
bool MarlinStage::wants_piece(double now_s) const {
  if (!active_ || active_->is_stopping || active_->sent == active_->target) return false;
  if (!active_->tracker) return true;
  const double steps = steps_per_m();
  const double sent_m = metres(active_->sent);
  const double piece_m = static_cast<double>(active_->piece) / steps;
  const double direction = is_toward() ? 1.0 : -1.0;
  const double planned_ahead_m =
      direction * (sent_m - viscard::position_m(active_->planned, now_s));
  const double reported_ahead_m = direction * (sent_m - reported_m_);
  return planned_ahead_m < 2.0 * piece_m &&
         reported_ahead_m < 3.0 * piece_m + active_->planned.speed_m_s * kOldReport_s;
}

void MarlinStage::send_piece() {
  ActiveMove& active = *active_;
  const long long left = active.target - active.sent;
  const long long step = std::min(active.piece, std::llabs(left));
  active.sent += left > 0 ? step : -step;
  // What is left for the next piece must not be too short to be made.
  if (std::llabs(active.target - active.sent) < kFewestSteps) active.sent = active.target;
  if (!active.tracker) {
    active.planned.start_time_s = clock_.now_s();
    active.progress_s = active.planned.start_time_s;
    active.tracker.emplace(active.planned, 1.0 / steps_per_m());
    expected_end_s_ = active.tracker->latest_end_s();
  }
  send(move_to(active.sent, active.feed_mm_min));
}

std::string MarlinStage::move_to(long long count, double feed_mm_min) const {
  const double to_mm = static_cast<double>(count - origin_count_) / steps_per_m() * 1e3;
  return format_marlin_move(config_.axis, to_mm, feed_mm_min);
}

void MarlinStage::follow_move(double asked_s, double received_s) {
  ActiveMove& active = *active_;
  if (active.is_stopping) return follow_stop(asked_s);
  if (!active.tracker) return;
  if (!presses_nothing_) active.tracker->reported(asked_s, received_s, reported_m_);
  watch_path(active.planned, 2.0 / steps_per_m(), active.n_astray);
  if (count_ != std::exchange(active.seen, count_)) active.progress_s = received_s;
  // The answer to the newest piece comes before its question.
  if (!active.ok_s || asked_s < *active.ok_s) return;
  // Reports that were not proven may be those of the plan, so its time has to pass as well.
  if (presses_nothing_ && asked_s < active.tracker->latest_end_s()) return;
  // The last step is still to come, or rounding has left it out.
  const double step_s = std::max(clock_.from_wall_s(kLastStep_wall_s),
                                 1.0 / (active.planned.speed_m_s * steps_per_m()));
  const long long off = std::llabs(count_ - active.target);
  const bool is_at_target = off == 0 || (off == 1 && asked_s > active.progress_s + step_s);
  active.sent == active.target&& is_at_target ? end_move() : rest_elsewhere(asked_s);
}

// A soft limit shortens a move, and some builds make none before homing, both with an ok.
void MarlinStage::rest_elsewhere(double asked_s) {
  const ActiveMove& active = *active_;
  // On a slow line it also rests between two pieces.
  const bool is_all_sent = active.sent == active.target;
  const double still_s =
      std::max(clock_.from_wall_s(is_all_sent ? kStill_wall_s : kStillBetween_wall_s),
               3.0 / (active.planned.speed_m_s * steps_per_m()));
  if (asked_s < active.progress_s + still_s) return;
  if (is_all_sent && asked_s < expected_end_s_ + still_s) return;
  const bool is_short = std::llabs(count_ - active.target) < kFewestSteps;
  if (!is_short && !is_toward()) {
    note(clock_.now_s(), "stage_clipped", text_from_number(reported_m_ * 1e3, 4),
         "The controller ended a move away from the specimen early: its travel ends there");
  }
  if (is_short || !is_toward()) return end_move();
  const double target_m = active.planned.to_m;
  active_.reset();
  throw_not_made(target_m);
}

void MarlinStage::throw_not_made(double target_m) {
  exact_m_.reset();
  throw_elsewhere(target_m, words_of_board(),
                  "a soft limit (M211), homing that is missing or a limit switch");
}

std::string MarlinStage::words_of_board() const {
  return last_message_.empty() ? "the board reports nothing"
                               : "it reported '" + last_message_ + "'";
}

void MarlinStage::end_move() {
  const ActiveMove ended = *std::exchange(active_, std::nullopt);
  hand_out(ended.tracker, ended.purpose, reported_m_);
}

// M410 is answered when the motors stand. Two equal reports are wanted, because one can be garbled.
void MarlinStage::follow_stop(double asked_s) {
  if (is_stop_open_ || asked_s < stopped_s_) return;
  const bool is_sure = active_->stood == count_;
  active_->stood = count_;
  next_poll_s_ = clock_.now_s();
  if (is_sure) end_move();
}

void MarlinStage::stop() {
  outbox_.clear();
  const double now_s = clock_.now_s();
  if (active_) {
    active_->is_stopping = true;
    next_poll_s_ = now_s;
  }
  const bool is_written =
      is_stop_open_ && now_s < stop_written_s_ + clock_.from_wall_s(kStopped_wall_s);
  if (!is_written) write_stop();
}

// Without a line number, because only so it is carried out before the lines that wait. With an
// emergency parser it also overtakes a piece that the firmware has not read yet.
void MarlinStage::write_stop() {
  n_stops_ = is_stop_open_ ? n_stops_ + 1 : 1;
  is_stop_open_ = true;
  is_piece_behind_ = is_piece_behind_ || (in_flight_ && in_flight_->command.rfind("G1", 0) == 0);
  stop_written_s_ = clock_.now_s();
  write("M410\n");
}

void MarlinStage::stop_soft() {
  stop();
}

void MarlinStage::stop_hard() {
  is_recovering_ = true;
  stop();
}

}  // namespace viscard
