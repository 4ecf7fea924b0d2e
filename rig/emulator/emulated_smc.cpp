#include "rig/emulator/emulated_smc.h"

#include "models/maths/text_of_number.h"
#include "rig/protocols/smc_protocol.h"

#include <cctype>
#include <cmath>
#include <cstdio>
#include <utility>

namespace viscard {
namespace {

namespace SmcStates {
constexpr unsigned kReset = 0x0a, kHomingFailed = 0x0b, kHoming = 0x1e, kMoving = 0x28,
                   kHomed = 0x32, kMoved = 0x33, kSwitchedOn = 0x34, kSwitchedOff = 0x3c,
                   kFailed = 0x3d;
}
constexpr unsigned kSmcPositiveEnd = 0x2, kSmcFollowing = 0x20, kSmcHomeTimeout = 0x40;
constexpr double kHold_s = 0.2;
constexpr std::size_t kRoomWhileHeld = 16;  // bytes that still fit into its buffer

std::string smc_number(double value) {
  return text_from_number(value, 6);
}

}  // namespace

EmulatedSmc::EmulatedSmc(const EmulatedTruth& truth, const StageConfig& stage,
                         const SmcHabits& habits)
    : EmulatedController(truth.steps_per_m),
      habits_(habits),
      steps_per_m_(truth.steps_per_m),
      toward_(stage.toward_specimen < 0 ? -1.0 : 1.0),
      address_(std::to_string(stage.device)),
      speed_mm_s_(truth.max_rate_m_s * 1e3),
      largest_speed_mm_s_(speed_mm_s_),
      acceleration_mm_s2_(truth.acceleration_m_s2 * 1e3),
      state_(habits.has_reference ? SmcStates::kHomed : SmcStates::kReset),
      error_(habits.stale_error) {}

double EmulatedSmc::position_mm(double time_s) const {
  const double counts = std::round(motion_.position_m(time_s) * steps_per_m_);
  return toward_ * counts / steps_per_m_ * 1e3 + offset_mm_;
}

void EmulatedSmc::reset(double time_s) {
  if (!std::exchange(has_started_, true) || !habits_.loses_power) return;
  motion_.stop_at_once(time_s);
  begun_.clear();
  answers_.clear();
  answers_.add(time_s, std::string(3, '\0'));
  offset_mm_ -= position_mm(time_s);
  state_ = SmcStates::kReset;
  faults_ = 0;
  error_ = '@';
}

void EmulatedSmc::hit_limit(double time_s) {
  motion_.stop_at_once(time_s);
  faults_ = habits_.limit_keeps_motor ? kSmcPositiveEnd : kSmcFollowing;
  state_ = habits_.limit_keeps_motor ? SmcStates::kMoved : SmcStates::kFailed;
}

void EmulatedSmc::update(double time_s) {
  if (motion_.is_moving(time_s)) return;
  if (state_ == SmcStates::kMoving) state_ = SmcStates::kMoved;
  if (state_ != SmcStates::kHoming) return;
  state_ = habits_.fails_to_home ? SmcStates::kHomingFailed : SmcStates::kHomed;
  if (habits_.fails_to_home) faults_ = kSmcHomeTimeout;
}

void EmulatedSmc::tick(double time_s) {
  if (held_until_s_ >= 0.0 && time_s >= held_until_s_) {
    held_until_s_ = -1.0;
    output_ += kSmcXon;
  }
  output_ += answers_.take_due(time_s);
}

void EmulatedSmc::receive(std::string_view bytes, double time_s) {
  update(time_s);
  for (const char c : bytes) {
    if (held_until_s_ >= 0.0 && ++n_bytes_held_ > kRoomWhileHeld) continue;
    if (c == '\n') {
      const std::string line = std::exchange(begun_, "");
      take_line(line, time_s);
    } else if (c != '\r' && c != ' ') {
      begun_ += static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    }
  }
}

void EmulatedSmc::take_line(std::string_view text, double time_s) {
  const bool is_for_all = text == "ST";
  const bool is_here = text.substr(0, address_.size()) == address_;
  if (!is_for_all && !is_here) return;
  if (is_here) text.remove_prefix(address_.size());
  if (text.size() < 2 || (time_s < deaf_until_s_ && text != "ST")) return;
  if (habits_.hold_every > 0 && ++n_lines_ % habits_.hold_every == 0) {
    output_ += kSmcXoff;
    held_until_s_ = time_s + kHold_s;
    n_bytes_held_ = 0;
  }
  const std::string_view letters = text.substr(0, 2), rest = text.substr(2);
  const bool is_told = letters == "TS" || letters == "TP" || letters == "TE" || letters == "VE";
  if (is_told || rest == "?") {
    const auto answer = answer_to(letters, time_s);
    if (answer) {
      send_answer(address_ + std::string(letters) + *answer + "\r\n", time_s, habits_.answers);
    }
    return;
  }
  deaf_until_s_ = time_s + habits_.deaf_after_command_s;
  obey(letters, number_from_text(rest), time_s);
}

std::optional<std::string> EmulatedSmc::answer_to(std::string_view letters, double time_s) {
  if (letters == "VE") return " SMC_CC V2.0.0";
  if (letters == "TE") return std::string(1, std::exchange(error_, '@'));
  if (letters == "TP") return smc_number(position_mm(time_s));
  if (letters == "TS") {
    char text[16] = {};
    std::snprintf(text, sizeof text, "%04X%02X", faults_ & 0xffffU, state_ & 0xffU);
    return text;
  }
  if (letters == "VA") return smc_number(speed_mm_s_);
  if (letters == "AC") return smc_number(acceleration_mm_s2_);
  if (letters == "SL") return smc_number(habits_.lowest_mm);
  if (letters == "SR") return smc_number(habits_.highest_mm);
  if (letters == "JR") return smc_number(habits_.jerk_time_s);
  if (letters == "PA" && habits_.knows_target) return smc_number(target_mm_);
  if (letters == "SU" && !habits_.is_pp) return text_from_number(1e3 / steps_per_m_, 9);
  error_ = letters == "SU" ? 'W' : 'A';  // and silence
  return std::nullopt;
}

char EmulatedSmc::refusal() const {
  const SmcState now{faults_, state_};
  if (is_smc_homing(now)) return 'L';
  if (!is_smc_referenced(now)) return 'H';
  if (is_smc_disabled(now)) return 'J';
  return is_smc_moving(now) ? 'M' : '@';
}

void EmulatedSmc::obey(std::string_view letters, std::optional<double> value, double time_s) {
  if (letters == "ST") {
    motion_.stop_gently(time_s, acceleration_mm_s2_ * 1e-3);
  } else if (letters == "OR") {
    if (is_smc_referenced({faults_, state_})) {
      error_ = 'K';
      return;
    }
    motion_.start(time_s, 0.0, 1e-3, acceleration_mm_s2_ * 1e-3);
    offset_mm_ = 0.0;
    target_mm_ = 0.0;
    state_ = SmcStates::kHoming;
  } else if (!value) {
    error_ = 'C';
  } else if (letters == "PA") {
    move(*value, time_s);
  } else if (letters == "VA") {
    if (*value > 0.0 && *value <= largest_speed_mm_s_ * (1.0 + 1e-9)) {
      speed_mm_s_ = *value;
    } else {
      error_ = 'C';
    }
  } else if (letters == "MM") {
    state_ = *value == 0.0 ? SmcStates::kSwitchedOff : SmcStates::kSwitchedOn;
    faults_ = 0;
  } else {
    error_ = 'A';
  }
}

void EmulatedSmc::move(double to_mm, double time_s) {
  if (refusal() != '@') {
    error_ = refusal();
  } else if (to_mm < habits_.lowest_mm || to_mm > habits_.highest_mm) {
    error_ = 'G';
  } else {
    faults_ = 0;
    target_mm_ = to_mm;
    motion_.start(time_s, toward_ * (to_mm - offset_mm_) * 1e-3, speed_mm_s_ * 1e-3,
                  acceleration_mm_s2_ * 1e-3);
    state_ = SmcStates::kMoving;
  }
}

}  // namespace viscard
