// How ZaberStage begins, follows and ends a move.
#include "rig/stages/zaber_stage.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace viscard {

void ZaberStage::follow_move(double asked_s, double received_s, bool is_busy) {
  constexpr int kMostRestsAside = 3;  // reports of rest at another place than the target
  ActiveMove& active = *active_;
  const bool has_begun = active.reply_s && asked_s >= *active.reply_s;
  if (active.tracker && !active.is_stopping) {
    active.tracker->reported(asked_s, received_s, reported_m_);
  }
  if (is_busy) return;
  if (active.is_stopping) {
    // The stop also counts if it came before the move itself had been sent.
    if (!action_ && asked_s >= active.stop_s) end_move(reported_m_);
    return;
  }
  if (!has_begun) return;
  const double target_m = metres(static_cast<double>(active.target));
  if (std::abs(reported_m_ - target_m) < 0.5 * config_.microstep_m) return end_move(target_m);
  if (++active.n_rests_elsewhere < kMostRestsAside) return;
  active_.reset();
  exact_m_.reset();
  throw_elsewhere(target_m, zaber_flag_text(flag_), "an obstacle or a turned knob");
}

void ZaberStage::end_move(double end_m) {
  const ActiveMove ended = *std::exchange(active_, std::nullopt);
  hand_out(ended.tracker, ended.purpose, end_m);
}

void ZaberStage::begin_move(double to_m, double speed_m_s, const std::string& purpose) {
  if (active_) throw RigError("a move was asked for while the stage was still moving");
  const StageDynamics limits = dynamics();
  const double from_m = position_m();
  const long long target = std::llround(toward_ * to_m / config_.microstep_m);
  to_m = metres(static_cast<double>(target));
  if (start_m_) check_travel(to_m, *start_m_, config_.travel_m);
  const double now_s = clock_.now_s();
  expected_end_s_ = now_s;
  if (std::abs(to_m - from_m) < 0.5 * config_.microstep_m) return;
  const double wanted_m_s = std::min(speed_m_s, limits.max_speed_m_s);
  const long long speed_data = zaber_speed_data(wanted_m_s / config_.microstep_m);
  const double real_m_s =
      microsteps_s_from_zaber(static_cast<double>(speed_data)) * config_.microstep_m;
  const StageMove move{now_s, from_m, to_m, real_m_s, limits.acceleration_m_s2};
  validate(move);
  active_ = ActiveMove{move, std::nullopt, purpose, target};
  expected_end_s_ = now_s + duration_s(move);
  next_poll_s_ = now_s + kPollMoving_s;
  // The move is sent only after the speed was accepted, so it is never faster than asked for.
  if (speed_data != speed_data_) actions_.push_back("set maxspeed " + std::to_string(speed_data));
  speed_data_ = speed_data;
  actions_.push_back("move abs " + std::to_string(target));
  start_action();
}

void ZaberStage::start_action() {
  if (action_ || actions_.empty()) return;
  action_ = send(actions_.front());
  actions_.pop_front();
  if (!active_ || action_->words.rfind("move abs", 0) != 0) return;
  active_->planned.start_time_s = action_->written_s;
  active_->late_before_s = clock_.late_s();
  active_->tracker.emplace(active_->planned, config_.microstep_m);
  expected_end_s_ = action_->written_s + duration_s(active_->planned);
}

void ZaberStage::stop(const std::string& words) {
  actions_.clear();
  action_ = send(words);
  if (!active_) return;
  active_->is_stopping = true;
  active_->stop_s = clock_.now_s();
  next_poll_s_ = active_->stop_s;
}

void ZaberStage::stop_soft() {
  stop("stop");
}

void ZaberStage::stop_hard() {
  is_recovering_ = true;
  stop("estop");
}

}  // namespace viscard
