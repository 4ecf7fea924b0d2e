#include "rig/emulator/emulated_apt.h"

#include <cmath>
#include <utility>

namespace viscard {
namespace {

constexpr std::size_t kHeader = 6;
bool is_nth(int number, int nth) {
  return nth > 0 && number == nth;
}
bool is_every(int number, int every) {
  return every > 0 && number % every == 0;
}

std::int32_t word_of(double value) {
  return static_cast<std::int32_t>(std::llround(value));
}

std::string i32(std::int32_t value) {
  return apt_bytes(static_cast<std::uint32_t>(value), 4);
}

}  // namespace

EmulatedApt::EmulatedApt(const EmulatedTruth& truth, int toward_specimen, const AptHabits& habits)
    : EmulatedController(truth.steps_per_m),
      habits_(habits),
      units_(apt_units(habits.model).value_or(AptUnits{})),
      count_m_(1.0 / truth.steps_per_m),
      toward_(toward_specimen < 0 ? -1.0 : 1.0),
      is_homed_(habits.is_homed) {
  if (!habits.has_no_speed) {
    velocity_.speed = word_of(truth.max_rate_m_s / count_m_ * units_.speed_word);
    velocity_.acceleration = word_of(truth.acceleration_m_s2 / count_m_ * units_.acceleration_word);
  }
  home_parameters_ =
      apt_bytes(1, 2) + apt_bytes(2, 2) + apt_bytes(1, 2) + i32(velocity_.speed) + apt_bytes(0, 4);
}

double EmulatedApt::speed_m_s() const {
  return velocity_.speed / units_.speed_word * count_m_;
}
double EmulatedApt::acceleration_m_s2() const {
  return velocity_.acceleration / units_.acceleration_word * count_m_;
}
std::int32_t EmulatedApt::counts(double time_s) const {
  return word_of(toward_ * (motion_.position_m(time_s) - origin_m_) / count_m_);
}

// Opening the port does not reset a unit; the first call is its power-up.
void EmulatedApt::reset(double time_s) {
  answers_.clear();
  begun_.clear();
  const bool has_run = std::exchange(has_run_, true);
  if (has_run && !habits_.loses_power) return;
  motion_.stop_at_once(time_s);
  due_.reset();
  is_enabled_ = is_homing_ = false;
  if (!has_run) return;
  is_homed_ = false;
  origin_m_ = motion_.position_m(time_s);
}

void EmulatedApt::hit_limit(double time_s) {
  motion_.stop_at_once(time_s);
  due_.reset();
  limit_at_m_ = motion_.position_m(time_s);
}

void EmulatedApt::receive(std::string_view bytes, double time_s) {
  // How a real unit comes into step again is not known; this one drops what is no header, and a
  // message that does not go on.
  constexpr double kLongestPause_s = 0.1;
  if (time_s > heard_s_ + kLongestPause_s) begun_.clear();
  heard_s_ = time_s;
  begun_ += bytes;
  while (begun_.size() >= kHeader) {
    if ((begun_[4] & 0x7f) != 0x50 || begun_[5] != 0x01) {
      begun_.erase(0, 1);
      continue;
    }
    const bool has_data = (static_cast<unsigned char>(begun_[4]) & 0x80U) != 0;
    const std::size_t n_data = has_data ? apt_u16(begun_, 2) : 0;
    if (begun_.size() < kHeader + n_data) return;
    const std::string message = begun_.substr(0, kHeader + n_data);
    begun_.erase(0, kHeader + n_data);
    obey(apt_u16(message, 0), has_data ? 0 : static_cast<std::uint8_t>(message[3]),
         std::string_view(message).substr(kHeader), time_s);
  }
}

// Unknown messages get no answer.
void EmulatedApt::obey(std::uint16_t id, std::uint8_t p2, std::string_view data, double time_s) {
  if (id == apt::kAskInfo) return reply(format_apt(apt::kInfo, info(), true), time_s);
  if (id == apt::kAskVelocity) {
    const std::string words =
        apt_bytes(1, 2) + apt_bytes(0, 4) + i32(velocity_.acceleration) + i32(velocity_.speed);
    return reply(format_apt(apt::kVelocity, words, true), time_s);
  }
  if (id == apt::kAskHome) return reply(format_apt(apt::kHome, home_parameters_, true), time_s);
  const bool is_own_status =
      id == (units_.is_stepper ? apt::kAskStepperStatus : apt::kAskServoStatus);
  if (is_own_status) {
    return reply(format_apt(static_cast<std::uint16_t>(id + 1), status(time_s), true), time_s);
  }
  if (id == apt::kEnable) is_enabled_ = p2 == 1 && !habits_.stays_disabled;
  if (id == apt::kSetHome && data.size() == 14) home_parameters_ = std::string(data);
  if (id == apt::kSetVelocity && data.size() == 14 &&
      !is_nth(++n_speeds_, habits_.lose_speed_number)) {
    velocity_ = {apt_i32(data, 6), apt_i32(data, 10)};
  }
  if (id == apt::kMoveAbsolute && data.size() == 6) move(apt_i32(data, 2), time_s);
  if (id == apt::kStop) stop(p2 != apt::kAtOnce, time_s);
  if (id == apt::kGoHome && is_enabled_ && apt_i32(home_parameters_, 6) > 0) {
    is_homing_ = true;
    is_homed_ = false;
    due_ = Due{time_s + habits_.start_delay_s, 0.0};
  }
}

void EmulatedApt::move(std::int32_t counts, double time_s) {
  ++n_moves_;
  if (is_nth(n_moves_, habits_.lose_move_number)) return;
  if (!is_enabled_ || motion_.is_moving(time_s) || velocity_.speed <= 0) return;
  double to_m = origin_m_ + toward_ * counts * count_m_;
  const double from_m = motion_.position_m(time_s);
  if (is_nth(n_moves_, habits_.misread_move_number)) to_m += to_m > from_m ? 1e-3 : -1e-3;
  if (is_nth(n_moves_, habits_.ends_short_number)) to_m = 0.5 * (from_m + to_m);
  due_ = Due{time_s + habits_.start_delay_s, to_m};
}

void EmulatedApt::stop(bool is_gentle, double time_s) {
  if (is_nth(++n_stops_, habits_.lose_stop_number)) return;
  is_stopped_ = due_.has_value() || motion_.is_moving(time_s);
  due_.reset();
  is_homing_ = false;
  is_gentle ? motion_.stop_gently(time_s, acceleration_m_s2()) : motion_.stop_at_once(time_s);
}

std::string EmulatedApt::info() const {
  std::string model = habits_.model;
  model.resize(8, '\0');
  std::string data = apt_bytes(27000001, 4) + model + apt_bytes(16, 2);
  data += apt_bytes(5, 1) + apt_bytes(1, 1) + apt_bytes(2, 1);  // firmware 2.1.5
  data.resize(82, '\0');
  return data + apt_bytes(1, 2);
}

std::uint32_t EmulatedApt::bits(double time_s) const {
  std::uint32_t bits = 0x10003100U;  // connected, tracking, settled, power
  if (motion_.is_moving(time_s)) bits |= is_homing_ ? 0x200U : 0x10U;
  if (limit_at_m_) bits |= 0x1U;
  if (is_homed_) bits |= apt::kIsHomed;
  if (is_enabled_) bits |= apt::kIsEnabled;
  return bits;
}

std::string EmulatedApt::status(double time_s) const {
  return apt_bytes(1, 2) + i32(counts(time_s)) + apt_bytes(0, 4) + apt_bytes(bits(time_s), 4);
}

void EmulatedApt::send_event(std::uint16_t id, double time_s) {
  answers_.add(time_s, habits_.events_carry_status ? format_apt(id, status(time_s), true)
                                                   : format_apt(id, 1, 0, true));
}

void EmulatedApt::reply(const std::string& bytes, double time_s) {
  ++n_replies_;
  if (is_every(n_replies_, habits_.lose_reply_every)) return;
  if (habits_.sends_event_before_reply) send_event(apt::kMoveCompleted, time_s);
  const double due_s = time_s + habits_.reply_delay_s;
  if (!is_every(n_replies_, habits_.pause_reply_every)) return answers_.add(due_s, bytes);
  answers_.add(due_s, bytes.substr(0, bytes.size() / 2));
  answers_.add(due_s + habits_.pause_s, bytes.substr(bytes.size() / 2));
}

void EmulatedApt::tick(double time_s) {
  if (due_ && time_s >= due_->time_s) {
    const Due due = *std::exchange(due_, std::nullopt);
    const double speed =
        is_homing_ ? apt_i32(home_parameters_, 6) / units_.speed_word * count_m_ : speed_m_s();
    const double acceleration = velocity_.acceleration > 0 ? acceleration_m_s2() : 1e-3;
    motion_.start(time_s, due.to_m, speed, acceleration);
    if (limit_at_m_ && motion_.is_moving(time_s)) limit_at_m_.reset();
    if (is_homing_ && !motion_.is_moving(time_s)) was_moving_ = true;
  }
  const bool is_moving_now = motion_.is_moving(time_s);
  if (was_moving_ && !is_moving_now) {
    if (std::exchange(is_homing_, false)) {
      is_homed_ = true;
      origin_m_ = motion_.position_m(time_s);
      if (habits_.sends_events) send_event(apt::kHomed, time_s);
    } else if (habits_.sends_events) {
      send_event(is_stopped_ ? apt::kStopped : apt::kMoveCompleted, time_s);
    }
    is_stopped_ = false;
  }
  was_moving_ = is_moving_now;
  output_ += answers_.take_due(time_s);
}

}  // namespace viscard
