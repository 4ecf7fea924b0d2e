#include "rig/stages/apt_stage.h"

#include "models/maths/text_of_number.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace viscard {
namespace {

constexpr double kBetweenWrites_wall_s = 3e-3;  // pyLabLib: closer messages get lost
constexpr double kMessage_wall_s = 0.5;         // longest pause within a message
// Confirmed words may be rounded by this much, below what matters for a move.
constexpr double kRounding = 1e-3;

bool confirms(std::int32_t confirmed, std::int32_t wanted) {
  return std::abs(static_cast<double>(confirmed) - wanted) <= std::max(0.5, kRounding * wanted);
}

}  // namespace

AptStage::AptStage(Transport& transport, const StageConfig& config, const RigClock& clock,
                   RecordSink sink)
    : PolledStage(transport, config, clock, std::move(sink)) {
  if (!(config_.microstep_m > 0.0)) {
    throw RigError(
        "an APT stage counts encoder counts or microsteps, and the rig file does not give their "
        "length. Set microstep under [stage]: \"0.0289394 um\" (34554.96 per mm) or \"0.0291511 "
        "um\" (34304) for Z8, MTS25 and MTS50, \"0.0406504 um\" (24600) for Z6, \"0.00244141 um\" "
        "(409600) for KST101 and LTS, \"0.0390625 um\" (25600) for TST001; check it once with a "
        "gauge");
  }
}

AptStage::~AptStage() {
  if (!is_speed_changed_ || has_no_speed_) return;
  try {
    write(format_apt_velocity(found_));
  } catch (...) {
    // The stage is gone.
  }
}

StageDynamics AptStage::dynamics() const {
  return {1.0 / config_.microstep_m, acceleration_m_s2(found_.acceleration),
          speed_m_s(found_.speed), speed_m_s(1.0)};
}

void AptStage::split(const Chunk& chunk) {
  PolledStage::split(chunk);  // for the words of another device
  messages_.feed(chunk.bytes, chunk.time_s, clock_.from_wall_s(kMessage_wall_s));
}

void AptStage::write(const std::string& bytes) {
  const double now_s = clock_.now_s();
  sink_(RawBytes{Device::kStage, true, now_s, bytes});
  transport_.write(bytes);
  next_write_s_ = now_s + clock_.from_wall_s(kBetweenWrites_wall_s);
}

void AptStage::service() {
  const double now_s = clock_.now_s();  // what was answered before has been sent by then
  receive();
  while (const auto line = splitter_.next()) hear(line->text);
  while (const auto message = messages_.next()) take_message(*message);
  drive(now_s);
}

void AptStage::take_message(const AptMessage& message) {
  if (message.id == awaited_) answer_ = message;
  const std::uint16_t status_id = units_.is_stepper ? apt::kStepperStatus : apt::kServoStatus;
  if (message.id == status_id) {
    if (const auto status = parse_apt_status(message)) take_status(*status, message.time_s);
  } else if (const auto velocity = parse_apt_velocity(message)) {
    take_velocity(*velocity);
  } else if (const auto error = parse_apt_error(message)) {
    note(message.time_s, "stage_message", *error, "The stage reports the error " + *error);
  } else if (message.id == apt::kMoveCompleted || message.id == apt::kStopped ||
             message.id == apt::kHomed) {
    // Some units never send these, and some send them late, so only the status ends a move.
    has_homed_ = has_homed_ || message.id == apt::kHomed;
    next_poll_s_ = message.time_s;
  }
}

void AptStage::take_status(const AptStatus& status, double time_s) {
  const auto asked_s = question_answered(time_s);
  bits_ = status.bits;
  take_report(time_s, metres(status.position), rests() ? "rests" : "moves");
  if (!is_recovering_) watch_bits();
  if (active_ && asked_s) follow_move(*asked_s, time_s);
}

void AptStage::watch_bits() {
  const bool is_enabled = (bits_ & apt::kIsEnabled) != 0;
  const bool is_homing_lost = is_homed_ && (bits_ & apt::kIsHomed) == 0;
  const bool is_trouble = is_homing_lost || !is_enabled || (bits_ & apt::kAnyError) != 0;
  if (!std::exchange(is_troubled_, is_trouble) || !is_trouble) {
    if (is_trouble) next_poll_s_ = clock_.now_s();  // a single status may have lost bytes
    return;
  }
  if (is_homing_lost) throw_reference_lost();
  exact_m_.reset();
  throw StageAlarm("the stage stopped with " +
                   (is_enabled ? apt_error_text(bits_)
                               : std::string("its motor switched off; was that done at the "
                                             "controller?")));
}

// The move follows when the controller has confirmed its speed, so it is never faster than asked
// for, and its record states the true speed.
void AptStage::take_velocity(const AptVelocity& velocity) {
  if (!active_ || active_->tracker || active_->is_due || active_->stop_mode != 0) return;
  if (!confirms(velocity.speed, active_->velocity.speed) ||
      !confirms(velocity.acceleration, active_->velocity.acceleration)) {
    return send_speed();
  }
  active_->planned.speed_m_s = speed_m_s(velocity.speed);
  active_->planned.acceleration_m_s2 = acceleration_m_s2(velocity.acceleration);
  active_->is_due = true;
}

void AptStage::send_speed() {
  if (++active_->n_speed_sent > kMostSends) {
    const double wanted_m_s = speed_m_s(active_->velocity.speed);
    active_.reset();
    throw RigError("the stage did not confirm a speed of " + text_from_number(wanted_m_s * 1e3, 4) +
                   " mm/s, so nothing was moved. Check its cable, and the largest speed and "
                   "acceleration of the stage");
  }
  active_->speed_sent_s = clock_.now_s();
  is_speed_changed_ = true;
  outbox_.push_back(format_apt_velocity(active_->velocity));
  outbox_.push_back(format_apt(apt::kAskVelocity, 1, 0));
}

void AptStage::send_move() {
  ActiveMove& active = *active_;
  active.is_due = false;
  ++active.n_sent;
  active.sent_s = clock_.now_s();
  active.planned.start_time_s = active.sent_s;
  active.tracker.emplace(active.planned, (units_.is_stepper ? 1.0 : 3.0) * config_.microstep_m);
  expected_end_s_ = active.sent_s + duration_s(active.planned);
  next_poll_s_ = std::min(active.sent_s + kPollMoving_s, expected_end_s_ + 2e-3);
  write(format_apt_move(active.target));
}

void AptStage::begin_move(double to_m, double speed, const std::string& purpose) {
  if (active_) throw RigError("a move was asked for while the stage was still moving");
  const double from_m = position_m();
  const auto target = static_cast<std::int32_t>(std::llround(toward_ * to_m / config_.microstep_m));
  to_m = metres(target);
  if (start_m_) check_travel(to_m, *start_m_, config_.travel_m);
  const double now_s = clock_.now_s();
  expected_end_s_ = now_s;
  if (std::abs(to_m - from_m) < 0.5 * config_.microstep_m) return;
  const double word =
      std::clamp(std::round(speed / speed_m_s(1.0)), 1.0, static_cast<double>(found_.speed));
  const StageMove move{now_s, from_m, to_m, speed_m_s(word), dynamics().acceleration_m_s2};
  validate(move);
  active_ =
      ActiveMove{move, {found_.acceleration, static_cast<std::int32_t>(word)}, target, purpose};
  active_->late_before_s = clock_.late_s();
  expected_end_s_ = now_s + duration_s(move);
  next_poll_s_ = now_s + kPollMoving_s;
  send_speed();
  drive(now_s);
}

void AptStage::follow_move(double asked_s, double received_s) {
  ActiveMove& active = *active_;
  if (active.stop_mode != 0) return follow_stop(asked_s);
  if (!active.tracker || active.is_due || asked_s < active.sent_s) return;
  active.tracker->reported(asked_s, received_s,
                           end_of_way_m(active.planned, reported_m_, rests(), kSettled_m));
  watch_path(active.planned, 2.0 * kSettled_m, active.n_astray);
  if (!rests()) return active.rests_since_s.reset();
  const double way_m = std::abs(active.planned.to_m - active.planned.from_m);
  const double off_m = std::abs(reported_m_ - active.planned.to_m);
  if (off_m < std::min(kSettled_m, 0.5 * way_m)) return end_move();
  rest_elsewhere(asked_s);
}

void AptStage::follow_stop(double asked_s) {
  ActiveMove& active = *active_;
  if (asked_s < active.stop_s) return;
  if (rests()) return end_move();
  const double braking_s = active.planned.speed_m_s / active.planned.acceleration_m_s2;
  if (asked_s < active.stop_s + braking_s + clock_.from_wall_s(kAnswer_wall_s)) return;
  stop(active.stop_mode);  // the first one was lost
}

// Right after its command a move may not have begun, and a servo may still settle.
void AptStage::rest_elsewhere(double asked_s) {
  ActiveMove& active = *active_;
  if (!active.rests_since_s) active.rests_since_s = asked_s;
  if (asked_s < *active.rests_since_s + clock_.from_wall_s(kSettle_wall_s)) return;
  if (std::abs(reported_m_ - active.planned.to_m) < kSettled_m) return end_move();
  const bool is_at_start = std::abs(reported_m_ - active.planned.from_m) < kSettled_m;
  if (is_at_start && active.n_sent < kMostSends) {
    active.rests_since_s.reset();
    active.is_due = true;  // the command was lost; its target is absolute
    return;
  }
  exact_m_.reset();
  if ((bits_ & apt::kAnyLimit) != 0) {
    throw StageAlarm("the stage stopped at a limit switch at " +
                     text_from_number(reported_m_ * 1e3, 4) + " mm");
  }
  const double target_m = active.planned.to_m;
  active_.reset();
  throw_elsewhere(target_m, "no limit switch is closed",
                  "an obstacle or somebody at the controller's buttons");
}

void AptStage::end_move() {
  const ActiveMove ended = *std::exchange(active_, std::nullopt);
  hand_out(ended.tracker, ended.purpose, reported_m_);
}

void AptStage::drive(double now_s) {
  const bool is_waiting = awaits_report(now_s);
  const double answer_s = clock_.from_wall_s(kAnswer_wall_s);
  if (active_ && active_->tracker && active_->stop_mode == 0) {
    watch_end(now_s, active_->planned, active_->late_before_s);
  } else if (active_ && !active_->tracker && !active_->is_due && active_->stop_mode == 0 &&
             now_s > active_->speed_sent_s + answer_s) {
    send_speed();
  }
  if (now_s < next_write_s_) return;
  if (!outbox_.empty()) {
    const std::string bytes = std::move(outbox_.front());
    outbox_.pop_front();
    return write(bytes);
  }
  if (active_ && active_->is_due) return send_move();
  if (!polls_ || is_waiting || now_s < next_poll_s_) return;
  write(format_apt(units_.is_stepper ? apt::kAskStepperStatus : apt::kAskServoStatus, 1, 0));
  asked(now_s);
  plan_poll(now_s, active_ ? kPollMoving_s : kPollResting_s);
}

// Written at once, even if the last message was written a moment ago; a lost one is sent again.
void AptStage::stop(std::uint8_t mode) {
  outbox_.clear();
  write(format_apt(apt::kStop, 1, mode));
  if (!active_) return;
  active_->is_due = false;
  active_->stop_mode = mode;
  active_->stop_s = clock_.now_s();
  next_poll_s_ = active_->stop_s;
}

void AptStage::stop_soft() {
  stop(apt::kWithRamp);
}

void AptStage::stop_hard() {
  is_recovering_ = true;
  stop(apt::kAtOnce);
}

}  // namespace viscard
