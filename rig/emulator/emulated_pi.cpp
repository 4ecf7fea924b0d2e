#include "rig/emulator/emulated_pi.h"

#include "models/maths/text_of_number.h"
#include "rig/protocols/pi_protocol.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace viscard {
namespace {

namespace PiError {
constexpr int kParameter = 1, kUnknown = 2, kNotReferenced = 5, kBeyondLimits = 7, kBadSpeed = 8,
              kAtLimit = 216, kMotion = 1024;
}

std::vector<std::string> pi_words(std::string_view text) {
  std::vector<std::string> words;
  for (const std::string_view word : split(text, ' ')) {
    if (!trimmed(word).empty()) words.emplace_back(trimmed(word));
  }
  return words;
}

std::string mm_text(double mm) {
  return text_from_number(mm, 7);
}

}  // namespace

EmulatedPi::EmulatedPi(const EmulatedTruth& truth, const StageConfig& stage, const PiHabits& habits)
    : EmulatedController(truth.steps_per_m),
      habits_(habits),
      steps_per_m_(truth.steps_per_m),
      toward_(stage.toward_specimen < 0 ? -1.0 : 1.0),
      device_(stage.device),
      axis_(std::to_string(stage.axis_number)),
      speed_mm_s_(0.5 * truth.max_rate_m_s * 1e3),
      largest_speed_mm_s_(truth.max_rate_m_s * 1e3),
      acceleration_mm_s2_(truth.acceleration_m_s2 * 1e3),
      deceleration_mm_s2_(habits.deceleration_ratio * acceleration_mm_s2_),
      has_reference_(habits.has_reference),
      error_(habits.stale_error) {}

double EmulatedPi::position_mm(double time_s) const {
  const double counts = std::round(motion_.position_m(time_s) * steps_per_m_);
  const double aside = motion_.is_moving(time_s) ? 0.0 : habits_.counts_beside_target;
  return toward_ * (counts + aside) / steps_per_m_ * 1e3 + offset_mm_;
}

void EmulatedPi::reset(double time_s) {
  if (!std::exchange(has_started_, true) || !habits_.loses_power) return;
  motion_.stop_at_once(time_s);
  begun_.clear();
  answers_.clear();
  has_servo_ = has_reference_ = false;
  needs_reference_ = true;
  error_ = 0;
  offset_mm_ -= position_mm(time_s);
  target_mm_ = 0.0;
}

void EmulatedPi::hit_limit(double time_s) {
  motion_.stop_at_once(time_s);
  error_ = habits_.limit_keeps_servo ? PiError::kAtLimit : PiError::kMotion;
  has_servo_ = has_servo_ && habits_.limit_keeps_servo;
}

void EmulatedPi::receive(std::string_view bytes, double time_s) {
  for (const char c : bytes) {
    if (c == kPiIsMoving || c == kPiIsReady || c == kPiStop) {
      take_byte(c, time_s);
    } else if (c == '\n') {
      const std::string line = std::exchange(begun_, "");
      take_line(line, time_s);
    } else {
      begun_ += c;
    }
  }
}

// Acts at once; an address in front of it is the whole text that has come of a line.
void EmulatedPi::take_byte(char byte, double time_s) {
  std::vector<std::string> words = pi_words(begun_);
  is_prefixed_ = words.size() == 1 && words[0] == std::to_string(device_);
  if (is_prefixed_) begun_.clear();
  if (byte == kPiIsReady) answer(is_homing(time_s) ? "\xb0" : "\xb1", time_s);
  if (byte == kPiIsMoving) {
    const bool is_second = axis_ == "2";
    answer(!motion_.is_moving(time_s) ? "0" : is_second ? "2" : "1", time_s);
  }
  if (byte != kPiStop) return;
  motion_.stop_at_once(time_s);
  error_ = kPiStopped;
}

bool EmulatedPi::is_addressed(std::vector<std::string>& words) {
  is_prefixed_ = words.size() > 1 && integer_from_text(words[0]).has_value();
  if (!is_prefixed_) return device_ == 1;
  const bool is_here = words[0] == std::to_string(device_);
  words.erase(words.begin());
  return is_here;
}

void EmulatedPi::take_line(std::string_view text, double time_s) {
  std::vector<std::string> words = pi_words(text);
  if (words.empty() || !is_addressed(words)) return;
  if (is_homing(time_s)) {
    error_ = PiError::kNotReferenced;
  } else if (words[0].back() != '?') {
    obey(words, time_s);
  } else if (const auto text_of_answer = answer_to(words, time_s)) {
    answer(*text_of_answer, time_s);
  } else {
    error_ = PiError::kUnknown;  // and silence
  }
}

std::optional<std::string> EmulatedPi::answer_to(const std::vector<std::string>& words,
                                                 double time_s) {
  const std::string& verb = words[0];
  if (verb == "*IDN?") return "(c)2013 Physik Instrumente (PI) Karlsruhe, C-863.11, 0, 1.2.1.0";
  if (verb == "ERR?") return std::to_string(std::exchange(error_, 0));
  if (words.size() < 2 || words[1] != axis_) return std::nullopt;
  const auto of_axis = [&](const std::string& value) {
    const std::string other = habits_.lists_two_axes ? " \n9=7.0000000" : "";
    return axis_ + "=" + value + other;
  };
  const auto flag = [&](bool is_set) { return of_axis(is_set ? "1" : "0"); };
  if (verb == "POS?") return of_axis(mm_text(position_mm(time_s)));
  if (verb == "MOV?") return of_axis(mm_text(target_mm_));
  if (verb == "SVO?") return flag(has_servo_);
  if (verb == "FRF?") return flag(has_reference_);
  if (verb == "RON?") return flag(needs_reference_);
  if (verb == "ONT?") {
    return flag(habits_.comes_on_target && has_servo_ && !motion_.is_moving(time_s));
  }
  if (verb == "VEL?") return of_axis(mm_text(speed_mm_s_));
  if (verb == "ACC?") return of_axis(mm_text(acceleration_mm_s2_));
  if (verb == "DEC?") return of_axis(mm_text(deceleration_mm_s2_));
  if (verb == "TMN?") return of_axis(mm_text(habits_.lowest_mm));
  if (verb == "TMX?") return of_axis(mm_text(habits_.highest_mm));
  if (verb != "SPA?" || words.size() != 3 || !habits_.has_parameters) return std::nullopt;
  const std::string name = axis_ + " " + words[2] + "=";
  if (words[2] == "0xA") return name + mm_text(largest_speed_mm_s_);
  if (words[2] == "0xE") return name + text_from_number(steps_per_m_, 0);
  if (words[2] == "0xF") return name + "1000";
  return std::nullopt;
}

void EmulatedPi::obey(const std::vector<std::string>& words, double time_s) {
  const std::string& verb = words[0];
  const bool is_of_axis = words.size() >= 2 && words[1] == axis_;
  const auto value = words.size() == 3 ? number_from_text(words[2]) : std::nullopt;
  if (is_of_axis && verb == "HLT") {
    motion_.stop_gently(time_s, deceleration_mm_s2_ * 1e-3);
    error_ = kPiStopped;
  } else if (is_of_axis && verb == "FRF") {
    motion_.start(time_s, 0.0, 1e-3, acceleration_mm_s2_ * 1e-3);
    is_homing_ = has_reference_ = true;
    offset_mm_ = 0.0;
  } else if (is_of_axis && value) {
    set(verb, *value, time_s);
  } else {
    error_ = PiError::kParameter;
  }
}

void EmulatedPi::set(const std::string& verb, double value, double time_s) {
  if (verb == "MOV") return move(value, time_s);
  if (verb == "SVO") {
    has_servo_ = value == 1.0;
  } else if (verb == "RON") {
    needs_reference_ = value == 1.0;
  } else if (verb == "POS") {
    if (needs_reference_) {
      error_ = PiError::kNotReferenced;
      return;
    }
    offset_mm_ += value - position_mm(time_s);
    has_reference_ = true;
  } else if (verb == "VEL") {
    if (value > 0.0 && value <= largest_speed_mm_s_) {
      speed_mm_s_ = value;
    } else {
      error_ = PiError::kBadSpeed;
    }
  } else if (verb == "ACC") {
    acceleration_mm_s2_ = value;
  } else if (verb == "DEC") {
    deceleration_mm_s2_ = value;
  } else {
    error_ = PiError::kUnknown;
  }
}

void EmulatedPi::move(double to_mm, double time_s) {
  is_homing_ = false;
  if (!has_servo_ || !has_reference_) {
    error_ = PiError::kNotReferenced;
  } else if (to_mm < habits_.lowest_mm || to_mm > habits_.highest_mm) {
    error_ = PiError::kBeyondLimits;
  } else {
    target_mm_ = to_mm;
    motion_.stop_at_once(time_s);
    motion_.start(time_s, toward_ * (to_mm - offset_mm_) * 1e-3, speed_mm_s_ * 1e-3,
                  acceleration_mm_s2_ * 1e-3);
  }
}

void EmulatedPi::answer(const std::string& text, double time_s) {
  const std::string prefix = is_prefixed_ ? "0 " + std::to_string(device_) + " " : "";
  send_answer(prefix + text + "\n", time_s, habits_.answers);
}

}  // namespace viscard
