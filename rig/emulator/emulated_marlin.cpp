#include "rig/emulator/emulated_marlin.h"

#include "models/maths/text_of_number.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

namespace viscard {
namespace {

constexpr double kFirstBlock_s = 0.1;        // BLOCK_DELAY_FOR_1ST_MOVE
constexpr double kShortestMove_steps = 6.0;  // MIN_STEPS_PER_SEGMENT
constexpr double kBusyEvery_s = 2.0;
constexpr std::size_t kBufferedLines = 4;

bool is_every_nth(int number, int every) {
  return every > 0 && number % every == 0;
}

// The number behind a letter.
std::optional<double> word(const std::string& command, char letter) {
  for (const std::string_view part : split(command, ' ')) {
    if (!part.empty() && part.front() == letter) return number_from_text(part.substr(1));
  }
  return std::nullopt;
}

}  // namespace

EmulatedMarlin::EmulatedMarlin(const EmulatedTruth& truth, char axis, int toward_specimen,
                               const MarlinHabits& habits)
    : EmulatedController(truth.steps_per_m),
      habits_(habits),
      axis_(axis),
      toward_(toward_specimen < 0 ? -1.0 : 1.0),
      step_m_(1.0 / truth.steps_per_m),
      max_speed_m_s_(truth.max_rate_m_s),
      acceleration_m_s2_(truth.acceleration_m_s2) {}

double EmulatedMarlin::end_m() const {
  return blocks_.empty() ? motion_.end_position_m() : blocks_.back().to_m;
}

void EmulatedMarlin::reset(double time_s) {
  motion_.stop_at_once(time_s);
  origin_m_ = zero_m_ = motion_.position_m(time_s);
  blocks_.clear();
  commands_.clear();
  answers_.clear();
  begun_.clear();
  last_number_ = 0;
  is_homed_ = is_homing_ = is_halted_ = false;
  is_stop_flagged_ = answers_stop_ = false;
  deaf_until_s_ = 0.0;
  stop_due_s_.reset();
  if (++n_starts_ == 1 && !habits_.talks_at_start) return;
  say("start", time_s);
  say("echo:Marlin 2.1.2", time_s + 0.1);
  say("echo: Last Updated: 2023-02-01 | Author: (bench)", time_s + 0.1);
  say("echo:  M92 X80.00 Y80.00 Z1.00 E93.00", time_s + 0.2);  // of the defaults, then its own
  say("echo:V88 stored settings retrieved (600 bytes; crc 1234)", time_s + 0.2);
}

void EmulatedMarlin::hit_limit(double time_s) {
  stop(time_s);
  say(std::string("echo:endstops hit:  ") + axis_ + ":0.00", time_s);
}

void EmulatedMarlin::stop(double time_s) {
  blocks_.clear();
  motion_.stop_at_once(time_s);
  is_homing_ = false;
}

// planner.cpp, quick_stop(), and motion.cpp, quickstop_stepper(): a stop that comes meanwhile
// begins the time again.
void EmulatedMarlin::quick_stop(double time_s) {
  stop(time_s);
  deaf_until_s_ = time_s + habits_.stopped_s;
}

void EmulatedMarlin::receive(std::string_view bytes, double time_s) {
  tick(time_s);
  for (const char c : bytes) {
    if (is_halted_) return;
    if (c != '\n' && c != '\r') {
      begun_ += c;
    } else if (!begun_.empty()) {
      line(std::exchange(begun_, ""), time_s);
    }
  }
  tick(time_s);
}

// Lines are checked, and stops carried out, when they arrive; the rest is done in order, a piece
// that came just before a stop after it.
void EmulatedMarlin::line(std::string text, double time_s) {
  if (text == "M410") {
    if (++n_stops_ == habits_.lose_stop_number) return;
    if (habits_.has_emergency_parser) {
      is_stop_flagged_ = time_s < deaf_until_s_;
      if (!is_stop_flagged_) quick_stop(time_s);
    } else if (commands_.size() < kBufferedLines) {
      stop_due_s_ = time_s + habits_.stop_delay_s;
    }
  } else {
    if (++n_lines_ == habits_.halt_number) {
      stop(time_s);
      is_halted_ = true;
      return say("Error:Printer halted. kill() called!", time_s);
    }
    if (is_every_nth(n_lines_, habits_.lose_line_every)) return;
    if (is_every_nth(n_lines_, habits_.garble_line_every)) text[text.size() / 2] ^= 1;
  }
  if (const auto command = checked(text, time_s)) commands_.push_back(*command);
}

std::optional<std::string> EmulatedMarlin::checked(const std::string& text, double time_s) {
  if (text.front() != 'N') return text;
  const std::size_t star = text.rfind('*');
  const std::size_t blank = std::min(text.find(' '), text.size());
  const auto number = integer_from_text(text.substr(1, blank - 1));
  const bool is_count = text.find("M110") != std::string::npos;
  if (!is_count && number != last_number_ + 1) {
    refuse("Line Number is not Last Line Number+1", time_s);
    return std::nullopt;
  }
  unsigned sum = 0;
  for (const char c : text.substr(0, star)) sum ^= static_cast<unsigned char>(c);
  if (star == std::string::npos || integer_from_text(text.substr(star + 1)) != sum) {
    refuse("checksum mismatch", time_s);
    return std::nullopt;
  }
  last_number_ = static_cast<long>(number.value_or(0));
  return text.substr(blank + 1, star - blank - 1);
}

void EmulatedMarlin::refuse(const std::string& error, double time_s) {
  say("Error:" + error + ", Last Line: " + std::to_string(last_number_), time_s);
  say("Resend: " + std::to_string(last_number_ + 1), time_s);
  if (habits_.sends_ok_after_resend) say("ok", time_s);
}

void EmulatedMarlin::say(const std::string& text, double time_s) {
  answers_.add(time_s + habits_.answer_delay_s, text + "\n");
}

void EmulatedMarlin::ok(double time_s) {
  if (is_every_nth(++n_oks_, habits_.lose_answer_every)) return;
  say(habits_.sends_advanced_ok ? "ok N" + std::to_string(last_number_) + " P15 B3" : "ok", time_s);
}

bool EmulatedMarlin::is_blocked(double time_s) {
  const bool is_moving_now = motion_.is_moving(time_s) || !blocks_.empty();
  const bool asks = commands_.front().rfind("M114", 0) == 0;
  const bool waits = asks && habits_.waits_in_m114 && is_moving_now;
  const bool stops = commands_.front() == "M410" && stop_due_s_.has_value();
  if (!waits && !stops && !is_homing_ && time_s >= deaf_until_s_) {
    busy_s_ = time_s + kBusyEvery_s;
    return false;
  }
  if (time_s >= busy_s_) {
    say("echo:busy: processing", time_s);
    busy_s_ = time_s + kBusyEvery_s;
  }
  return true;
}

void EmulatedMarlin::obey(const std::string& command, double time_s) {
  const std::string code = command.substr(0, command.find(' '));
  if (code == "G1") {
    move(command, time_s);
  } else if (code == "M114") {
    const bool is_real = habits_.has_realtime_reports && command == "M114 R";
    say(position(is_real ? motion_.position_m(time_s) : end_m()), time_s);
  } else if (code == "M115") {
    say("FIRMWARE_NAME:" + habits_.firmware +
            " SOURCE_CODE_URL:github.com/MarlinFirmware/Marlin PROTOCOL_VERSION:1.0",
        time_s);
    say("Cap:SERIAL_XON_XOFF:0", time_s);
    say(std::string("Cap:EMERGENCY_PARSER:") + (habits_.has_emergency_parser ? "1" : "0"), time_s);
  } else if (code == "M503") {
    say(settings(), time_s);
  } else if (code == "M410" && !habits_.has_emergency_parser) {
    quick_stop(time_s);
    answers_stop_ = true;
    return;  // its ok follows then
  } else if (code == "G92") {
    zero_m_ = end_m() - toward_ * word(command, axis_).value_or(0.0) * 1e-3;
  } else if (code == "G28") {
    is_homing_ = is_homed_ = true;
    home_until_s_ = time_s + habits_.homing_s;
    motion_.start(time_s, 0.0, 5e-3, acceleration_m_s2_);
    return;  // its ok follows at the end
  } else if (code != "M110" && code != "G21" && code != "G90" && code != "M17" && code != "M18" &&
             code != "M410") {
    say("echo:Unknown command: \"" + command + "\"", time_s);
  }
  ok(time_s);
}

void EmulatedMarlin::move(const std::string& command, double time_s) {
  if (const auto feed = word(command, 'F')) speed_m_s_ = *feed / 60e3;
  const auto to_mm = word(command, axis_);
  if (!to_mm) return;
  if (habits_.needs_home && !is_homed_) return say("echo:Home XYZ first", time_s);
  const double to_m =
      std::clamp(zero_m_ + toward_ * *to_mm * 1e-3, habits_.lowest_m, habits_.highest_m);
  const double steps = std::round(std::abs(to_m - end_m()) / step_m_);
  if (steps < (habits_.makes_short_moves ? 1.0 : kShortestMove_steps)) return;
  const double speed_m_s = std::clamp(speed_m_s_, 0.05e-3, max_speed_m_s_) * habits_.true_speed;
  add_block({to_m, speed_m_s}, time_s);
}

// A move that is being made cannot be changed any more, only one that waits.
void EmulatedMarlin::add_block(Block block, double time_s) {
  const double at_m = motion_.position_m(time_s);
  const double end = motion_.end_position_m();
  const bool is_ahead = std::abs(end - at_m) > std::abs(end - last_begins_m_);
  const bool is_in_line = (block.to_m > end) == (end > at_m) && block.speed_m_s == joined_m_s_;
  if (blocks_.empty() && motion_.is_moving(time_s) && is_ahead && is_in_line) {
    last_begins_m_ = end;
    return motion_.extend(block.to_m);
  }
  if (blocks_.empty() && !motion_.is_moving(time_s)) deliver_s_ = time_s + kFirstBlock_s;
  blocks_.push_back(block);
}

void EmulatedMarlin::begin_blocks(double time_s) {
  const Block first = blocks_.front();
  const bool is_up = first.to_m > motion_.end_position_m();
  last_begins_m_ = motion_.end_position_m();
  joined_m_s_ = first.speed_m_s;
  double to_m = first.to_m;
  blocks_.pop_front();
  while (!blocks_.empty() && (blocks_.front().to_m > to_m) == is_up &&
         blocks_.front().speed_m_s == first.speed_m_s) {
    last_begins_m_ = std::exchange(to_m, blocks_.front().to_m);
    blocks_.pop_front();
  }
  motion_.start(time_s, to_m, first.speed_m_s, acceleration_m_s2_);
}

// at_m: what Count reports.
std::string EmulatedMarlin::position(double at_m) const {
  const auto count = std::llround(toward_ * (at_m - origin_m_) / step_m_);
  const double projected_mm = toward_ * (end_m() - zero_m_) * 1e3;
  const auto text = [&](char name, const std::string& value) {
    return std::string(1, name) + ":" + (name == axis_ ? value : "0") + " ";
  };
  const std::string ends = text_from_number(projected_mm, 2), steps = std::to_string(count);
  return text('X', ends) + text('Y', ends) + text('Z', ends) + "E:0.00 Count " + text('X', steps) +
         text('Y', steps) + text('Z', " " + steps);
}

std::string EmulatedMarlin::settings() const {
  const std::string steps = text_from_number(1e-3 / step_m_, 2);
  const std::string speed = text_from_number(max_speed_m_s_ * 1e3, 2);
  const std::string acceleration = text_from_number(acceleration_m_s2_ * 1e3, 2);
  const auto all = [](const std::string& value) {
    return " X" + value + " Y" + value + " Z" + value + " E93.00\n";
  };
  return "echo:; Steps per unit:\necho: M92" + all(steps) +
         "echo:; Maximum feedrates (units/s):\n" + "echo:  M203" + all(speed) +
         "echo:; Maximum Acceleration (units/s2):\necho:  M201" + all(acceleration) +
         "echo:; Acceleration (units/s2):\necho:  M204 P3000.00 R3000.00 T3000.00";
}

void EmulatedMarlin::tick(double time_s) {
  if (stop_due_s_ && time_s >= *stop_due_s_) {
    stop_due_s_.reset();
    quick_stop(time_s);
  }
  if (answers_stop_ && time_s >= deaf_until_s_) {
    answers_stop_ = false;
    ok(time_s);
  }
  if (is_homing_ && !motion_.is_moving(time_s) && time_s >= home_until_s_) {
    if (habits_.restarts_in_homing) return reset(time_s);
    is_homing_ = false;
    origin_m_ = zero_m_ = motion_.position_m(time_s);
    ok(time_s);
  }
  while (!commands_.empty() && !is_blocked(time_s)) {
    const std::string command = std::move(commands_.front());
    commands_.pop_front();
    obey(command, time_s);
  }
  if (is_stop_flagged_ && time_s >= deaf_until_s_) {
    is_stop_flagged_ = false;
    quick_stop(time_s);
  }
  if (!motion_.is_moving(time_s) && !blocks_.empty() &&
      (time_s >= deliver_s_ || blocks_.size() >= 3)) {
    begin_blocks(time_s);
  }
  output_ += answers_.take_due(time_s);
}

}  // namespace viscard
