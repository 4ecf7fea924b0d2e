// How GrblStage uses position reports: when to ask, which question a report answers, whether a move
// stays on its path, and when it has ended.
#include "models/maths/text_of_number.h"
#include "rig/stages/grbl_stage.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace viscard {
namespace {

constexpr double kPollMoving_s = 0.1;  // rig time; the firmware recommends at most 5 to 10 Hz
constexpr double kPollResting_s = 0.2;
constexpr int kMostRestsElsewhere = 3;
constexpr double kNudge_wall_s = 0.7;
constexpr double kNoAnswer_wall_s = 5.0;

}  // namespace

std::optional<double> GrblStage::reported_position_m(const GrblStatus& status) {
  if (!status.work_offset_mm.empty()) work_offset_mm_ = status.work_offset_mm;
  const auto i = static_cast<std::size_t>(axis_);
  const double mm = setting(13, 0.0) != 0.0 ? 25.4 : 1.0;
  if (i < status.machine_mm.size()) return toward_ * status.machine_mm[i] * mm * 1e-3;
  if (i < status.work_mm.size() && i < work_offset_mm_.size()) {
    return toward_ * (status.work_mm[i] + work_offset_mm_[i]) * mm * 1e-3;
  }
  return std::nullopt;  // a work position whose offset is not known yet
}

void GrblStage::take_status(const GrblStatus& status, double time_s) {
  const auto asked_s = question_answered(time_s);
  state_ = status.state;
  const auto position = reported_position_m(status);
  if (!position) return;
  if (active_ && std::abs(*position - reported_m_) > 0.25e-6) active_->progress_s = time_s;
  take_report(time_s, *position, state_);
  if (active_ && asked_s) follow_move(*asked_s, time_s);
}

void GrblStage::follow_move(double asked_s, double received_s) {
  ActiveMove& active = *active_;
  if (state_ == "Hold" || state_ == "Door") {
    throw RigError(
        "the stage reports '" + state_ +
        "' in the middle of a move: somebody pressed its hold button or opened its door, "
        "or the line is disturbed. Release it, then start the run again");
  }
  if (!active.is_stopping) active.tracker.reported(asked_s, received_s, reported_m_);
  watch_path(active.tracker.move(), 2.0 * resolution_m(), active.n_astray);
  // An Idle that may be older than the ok is no proof that this move has ended.
  if (state_ != "Idle" || !active.has_ok || asked_s < active.ok_s) return;
  const double target_m = active.tracker.move().to_m;
  if (std::abs(reported_m_ - target_m) <= resolution_m()) return end_move(target_m);
  rest_elsewhere(asked_s);
}

void GrblStage::rest_elsewhere(double asked_s) {
  ActiveMove& active = *active_;
  if (active.is_stopping) {
    if (asked_s < active.stop_s) return;
    // Two equal reports are wanted, because one can be garbled and this position is kept.
    const bool is_sure = active.stood_m && *active.stood_m == reported_m_;
    active.stood_m = reported_m_;
    next_poll_s_ = clock_.now_s();
    if (is_sure) end_move(reported_m_);
    return;
  }
  if (++active.n_rests_elsewhere < kMostRestsElsewhere) return;
  const double target_m = active.tracker.move().to_m;
  active_.reset();
  exact_m_.reset();
  throw_elsewhere(target_m, state_,
                  "an obstacle, a limit switch or somebody who pressed the hold button");
}

void GrblStage::end_move(double end_m) {
  const ActiveMove ended = *std::exchange(active_, std::nullopt);
  hand_out(ended.tracker, ended.purpose, end_m);
}

void GrblStage::poll_status() {
  const double now_s = clock_.now_s();
  const bool is_waiting = awaits_report(now_s);
  watch_deadlines(now_s);
  if (is_waiting || now_s < next_poll_s_) return;
  send_realtime(grbl::kStatus);
  asked(now_s);
  plan_poll(now_s, active_ ? kPollMoving_s : kPollResting_s);
}

// A jog cancel that arrives at the moment when a jog ends, or a disturbed line, can leave GRBL in a
// hold although it reports Idle: it then answers '?' but no line until '~', which otherwise does
// nothing (gnea/grbl protocol.c, protocol_exec_rt_system).
void GrblStage::nudge(double now_s) {
  if (active_->is_nudged || state_ != "Idle") return;
  active_->is_nudged = true;
  send_realtime(grbl::kResume);
  note(now_s, "stage_nudged", "", "A move stayed unanswered at Idle; the stage was sent a resume");
}

void GrblStage::watch_deadlines(double now_s) {
  if (!active_) return;
  const StageMove& move = active_->tracker.move();
  watch_end(now_s, move, active_->late_before_s, active_->progress_s);
  now_s -= clock_.late_s() - active_->late_before_s;  // nobody listened meanwhile
  const double written_s = move.start_time_s;
  if (!active_->has_ok) {
    if (now_s > written_s + clock_.from_wall_s(patience_ * kNudge_wall_s)) nudge(now_s);
    if (now_s > written_s + clock_.from_wall_s(patience_ * kNoAnswer_wall_s)) {
      throw RigError("the stage did not answer a move within " +
                     text_from_number(patience_ * kNoAnswer_wall_s, 1) +
                     " s. Check its cable and supply");
    }
  }
}

}  // namespace viscard
