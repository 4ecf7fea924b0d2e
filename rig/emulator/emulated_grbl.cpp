#include "rig/emulator/emulated_grbl.h"

#include "models/maths/text_of_number.h"
#include "rig/protocols/grbl_protocol.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <utility>

namespace viscard {
namespace {

constexpr std::size_t kLineLength = 79;  // gnea/grbl LINE_BUFFER_SIZE 80 with the NUL
constexpr double kAlarmDelay_s = 0.5;
// Settings that neither the truth nor the habits change.
constexpr std::string_view kDefaults =
    "$0=10 $1=255 $2=0 $3=0 $4=0 $5=0 $6=0 $11=0.01 $12=0.002 $21=0 $23=0 $24=25 $25=500 $26=250 "
    "$27=1 $30=1000 $31=0 $32=0";

// The real speed for a requested one, because of the timer (gnea/grbl stepper.c at 16 MHz): the
// cycles of one step are rounded up and, below 8000 steps/s, divided by 2, 4 or 8 without the rest
// (AMASS). The timer clears itself after the compared number of cycles (CTC), so each of its
// periods has one more cycle. At a thousand cycles and more a period, moves are up to 0.1 % slower.
double timer_speed_m_s(double speed_m_s, double steps_per_m) {
  constexpr double kClock_Hz = 16e6;
  constexpr double kLongest = 65535.0;
  const double cycles = std::ceil(kClock_Hz / (speed_m_s * steps_per_m));
  const double parts = cycles < 2000.0 ? 1.0 : cycles < 4000.0 ? 2.0 : cycles < 8000.0 ? 4.0 : 8.0;
  const double period = std::min(kLongest, std::floor(cycles / parts)) + 1.0;
  return kClock_Hz / (parts * period * steps_per_m);
}

}  // namespace

EmulatedGrbl::EmulatedGrbl(const EmulatedTruth& truth, char axis, int toward_specimen,
                           const GrblHabits& habits)
    : EmulatedController(truth.steps_per_m, habits.counts_m),
      habits_(habits),
      axis_(axis == 'X' ? 0 : (axis == 'Y' ? 1 : 2)),
      toward_(toward_specimen < 0 ? -1.0 : 1.0) {
  for (const std::string_view line : split(kDefaults, ' ')) {
    const auto setting = parse_grbl_setting(line);
    settings_[setting->number] = setting->value;
  }
  settings_[10] = habits.reports_work_position ? 0.0 : 1.0;
  settings_[13] = habits.reports_inches ? 1.0 : 0.0;
  settings_[20] = habits.soft_limit_mm > 0.0 ? 1.0 : 0.0;
  settings_[21] = habits.has_hard_limits ? 1.0 : 0.0;
  settings_[22] = habits.is_homing_enabled ? 1.0 : 0.0;
  for (int i = 0; i < 3; ++i) {
    settings_[100 + i] = truth.steps_per_m * 1e-3;
    settings_[110 + i] = truth.max_rate_m_s * 60e3;
    settings_[120 + i] = truth.acceleration_m_s2 * 1e3;
    settings_[130 + i] = habits.soft_limit_mm > 0.0 ? habits.soft_limit_mm : 200.0;
  }
  load_axis_settings();
}

void EmulatedGrbl::load_axis_settings() {
  const int i = static_cast<int>(axis_);
  steps_per_m_ = settings_[100 + i] * 1e3;
  max_rate_m_s_ = settings_[110 + i] / 60e3;
  acceleration_m_s2_ = settings_[120 + i] * 1e-3;
  motion_.set_steps_per_m(steps_per_m_);
}

double EmulatedGrbl::machine_mm(double bench_m) const {
  return toward_ * (bench_m - machine_origin_m_) * 1e3;
}

double EmulatedGrbl::bench_m(double machine_mm) const {
  return machine_origin_m_ + toward_ * machine_mm * 1e-3;
}

double EmulatedGrbl::true_speed_m_s(double asked_m_s) const {
  const bool is_rounded = habits_.has_avr_timer && !habits_.is_hal;
  return habits_.true_speed * (is_rounded ? timer_speed_m_s(asked_m_s, steps_per_m_) : asked_m_s);
}

void EmulatedGrbl::reset(double time_s) {
  motion_.stop_at_once(time_s);
  // After power-up, zero is where it stands.
  machine_origin_m_ = habits_.is_homed ? home_origin_m(kHomeAt_m) : motion_.position_m(time_s);
  answers_.clear();
  late_reports_.clear();
  output_.clear();
  if (habits_.has_empty_eeprom && !is_eeprom_dumped_) {
    output_ = "error:7\r\n" + settings_text();
    is_eeprom_dumped_ = true;
  }
  const bool is_locked = !habits_.is_homed && !habits_.is_unlocked_at_boot;
  state_ = habits_.is_homing_enabled && is_locked ? "Alarm" : "Idle";
  habits_.is_homed = false;  // a further restart forgets it
  is_silent_ = false;
  deaf_until_s_.reset();
  welcome();
}

void EmulatedGrbl::welcome() {
  queue_.clear();
  held_lines_.clear();
  is_held_ = false;
  is_cancelling_ = false;
  begun_line_.clear();
  output_ += habits_.is_hal ? "\r\nGrblHAL 1.1f ['$' or '$HELP' for help]\r\n"
                            : "\r\nGrbl 1.1h ['$' for help]\r\n";
  if (state_ == "Alarm") output_ += "[MSG:'$H'|'$X' to unlock]\r\n";
  if (habits_.has_startup_block) output_ += ">G54G21:ok\r\n";
  // gnea/grbl: if the settings had to be restored, the stored start-up lines are unreadable too.
  if (habits_.has_empty_eeprom) output_ += ">:error:7\r\n>:error:7\r\n";
}

void EmulatedGrbl::soft_reset(double time_s) {
  const bool was_moving = motion_.is_moving(time_s);
  answers_.clear();
  motion_.stop_at_once(time_s);
  // An alarm survives a reset, and a reset in motion raises one.
  state_ = was_moving || state_ == "Alarm" ? "Alarm" : "Idle";
  is_silent_ = false;
  if (!was_moving) return welcome();
  output_ += "ALARM:3\r\n";
  begin_alarm(time_s);
}

// After reporting an alarm the firmware waits half a second, and all bytes that arrive meanwhile
// are lost, even a reset (gnea/grbl report.c, report_alarm_message; protocol.c clears EXEC_RESET
// after it).
void EmulatedGrbl::begin_alarm(double time_s) {
  queue_.clear();
  begun_line_.clear();
  deaf_until_s_ = time_s + kAlarmDelay_s;
}

void EmulatedGrbl::end_alarm() {
  deaf_until_s_.reset();
  if (is_silent_) {
    output_ += "[MSG:Reset to continue]\r\n";
  } else {
    welcome();
  }
}

// The motor counts lost steps, so that the count at which it stands at home or at the switch changes.
double EmulatedGrbl::home_m() const {
  return kHomeAt_m + lost_m_;
}

// The switch is further away from the specimen by the pull-off $27.
double EmulatedGrbl::switch_m() const {
  return home_m() - settings_.at(27) * 1e-3;
}

// Machine zero is the switch, if the stage homes to its positive end.
double EmulatedGrbl::home_origin_m(double at_m) const {
  return at_m + toward_ * settings_.at(27) * 1e-3;
}

// When the stage has come to its switch since the last tick. It homes past it without an alarm.
std::optional<double> EmulatedGrbl::meets_switch_at_s(double time_s) const {
  if (settings_.at(21) == 0.0 || state_ == "Home" || state_ == "Alarm") return std::nullopt;
  const auto is_on_it = [&](double at_s) { return motion_.position_m(at_s) <= switch_m(); };
  if (is_on_it(ticked_s_) || !is_on_it(time_s)) return std::nullopt;
  double before_s = ticked_s_, on_it_s = time_s;
  for (int i = 0; i < 40; ++i) {
    const double middle_s = 0.5 * (before_s + on_it_s);
    (is_on_it(middle_s) ? on_it_s : before_s) = middle_s;
  }
  return on_it_s;
}

void EmulatedGrbl::hit_limit(double time_s) {
  motion_.stop_at_once(time_s);
  queue_.clear();
  answers_.clear();
  state_ = "Alarm";
  is_silent_ = true;
  is_on_switch_ = !is_on_switch_;
  output_ += "ALARM:1\r\n";
  begin_alarm(time_s);
}

void EmulatedGrbl::receive(std::string_view bytes, double time_s) {
  tick(time_s);
  if (deaf_until_s_) return;
  for (const char c : bytes) {
    const bool is_realtime = c == grbl::kStatus || c == grbl::kHold || c == grbl::kResume ||
                             c == grbl::kSoftReset || static_cast<unsigned char>(c) >= 0x80;
    if (is_realtime) {
      realtime(c, time_s);
    } else if (c == '\n' || c == '\r') {
      take(std::exchange(begun_line_, {}), time_s);
    } else if (begun_line_.size() <= kLineLength) {
      if (c != ' ') begun_line_ += static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    }
  }
}

void EmulatedGrbl::realtime(char c, double time_s) {
  if (c == grbl::kSoftReset) return soft_reset(time_s);
  if (is_silent_) return;
  if (c == grbl::kStatus) {
    ++n_status_;
    const bool is_lost =
        habits_.lose_status_every > 0 && n_status_ % habits_.lose_status_every == 0;
    if (state_ != "Home" && !is_lost) report(time_s);
  } else if (c == grbl::kJogCancel && state_ == "Jog") {
    queue_.clear();
    motion_.stop_gently(time_s, acceleration_m_s2_);
    is_cancelling_ = true;
  } else if (c == grbl::kHold && (state_ == "Jog" || state_ == "Run" || state_ == "Idle")) {
    // As in the real firmware, a hold cancels a jog, and at rest it blocks until '~'.
    if (state_ == "Idle") {
      state_ = "Hold";
    } else {
      queue_.clear();
      motion_.stop_gently(time_s, acceleration_m_s2_);
    }
  } else if (c == grbl::kResume) {
    if (state_ == "Hold") state_ = "Idle";
    is_held_ = false;
    while (!is_held_ && !held_lines_.empty()) {
      const std::string text = std::move(held_lines_.front());
      held_lines_.pop_front();
      line(text, time_s);
    }
  }
}

void EmulatedGrbl::report(double time_s) {
  const std::string text = status(time_s);
  late_reports_.add(time_s + habits_.status_delay_s, habits_.reports_twice ? text + text : text);
  tick(time_s);
}

// A controller on hold keeps lines in its buffer until it is resumed.
void EmulatedGrbl::take(std::string text, double time_s) {
  if (is_held_ || state_ == "Hold") {
    held_lines_.push_back(std::move(text));
  } else {
    line(std::move(text), time_s);
  }
}

void EmulatedGrbl::answer(double time_s, const std::string& text) {
  answers_.add(time_s + habits_.ok_delay_s, text);
}

void EmulatedGrbl::ok(double time_s) {
  if (++n_oks_ == habits_.lose_ok_number) return;
  answer(time_s, habits_.answers_twice ? "ok\r\nok\r\n" : "ok\r\n");
}

void EmulatedGrbl::error(double time_s, int code) {
  answer(time_s, "error:" + std::to_string(code) + "\r\n");
}

void EmulatedGrbl::line(std::string text, double time_s) {
  if (is_silent_) {
    if (text == "$X") output_ += "[MSG:Reset to continue]\r\n";
    return;
  }
  if (text.size() > kLineLength) return error(time_s, 11);
  if (text.empty()) return ok(time_s);
  if (text[0] == '$') return dollar(text, time_s);
  if (state_ == "Alarm" || state_ == "Jog") return error(time_s, 9);
  const bool is_harmless =
      text.rfind("G4P", 0) == 0 || text == "G21" || text == "G90" || text == "G91" || text == "G94";
  if (!std::isalpha(static_cast<unsigned char>(text[0]))) return error(time_s, 1);
  if (!is_harmless) return error(time_s, 20);
  ok(time_s);
}

void EmulatedGrbl::tick(double time_s) {
  if (deaf_until_s_ && time_s >= *deaf_until_s_) end_alarm();
  if (const auto met_s = meets_switch_at_s(time_s)) hit_limit(*met_s);
  ticked_s_ = std::max(ticked_s_, time_s);
  while (!motion_.is_moving(time_s)) {
    if (state_ == "Home") {
      end_homing(time_s);
      break;
    }
    if (queue_.empty()) {
      if (state_ == "Jog" && !habits_.never_rests) state_ = "Idle";
      if (is_cancelling_ && habits_.holds_after_cancel) is_held_ = true;
      is_cancelling_ = false;
      break;
    }
    const QueuedMove move = queue_.front();
    queue_.pop_front();
    // Starts now, not at the end of the previous move: no position was asked for in between.
    motion_.start(time_s, move.to_m, true_speed_m_s(move.speed_m_s), acceleration_m_s2_);
    // The stage leaves the switch at once, and the change of its pin raises another alarm.
    if (is_on_switch_ && habits_.alarms_again) return hit_limit(time_s);
  }
  output_ += answers_.take_due(time_s) + late_reports_.take_due(time_s);
}

}  // namespace viscard
