// The exchanges of GrblStage that wait for answers: connecting, settings, recovery.
#include "models/maths/leading_number.h"
#include "models/maths/text_of_number.h"
#include "rig/stages/grbl_stage.h"

#include <cmath>
#include <utility>

namespace viscard {
namespace {

constexpr double kBoot_wall_s = 3.0;     // bootloader of an AVR board and the firmware's start
constexpr double kSettle_wall_s = 0.05;  // messages that follow a welcome
constexpr double kReset_wall_s = 1.5;    // from a soft reset to the welcome
constexpr int kResets = 3;               // one is lost while an alarm is being reported
constexpr int kMostReadings = 4;         // of the settings, until two agree

}  // namespace

void GrblStage::command(const std::string& line, const Pump& pump, double timeout_wall_s) {
  awaited_error_.reset();
  const int n_welcomes = n_welcomes_;
  send_line(line, true);
  if (!wait_for([&] { return pending_.empty(); }, pump, timeout_wall_s)) {
    throw RigError("the stage on '" + transport_.name() + "' did not answer '" + line +
                   "' within " + text_from_number(timeout_wall_s, 0) + " s. Switch it off and on");
  }
  if (n_welcomes != n_welcomes_) {
    throw RigError("the stage's controller restarted and did not answer '" + line +
                   "'. Check its supply, then try again");
  }
  if (awaited_error_) {
    throw RigError("the stage refused '" + line + "': " + grbl_error_text(*awaited_error_));
  }
}

// Many boards reset when their port is opened and send a welcome within seconds. The others get a
// soft reset, which at rest keeps the position.
void GrblStage::await_welcome(const Pump& pump) {
  const auto is_there = [&] { return !awaits_welcome_; };
  bool is_welcome = wait_for(is_there, pump, kBoot_wall_s);
  restarts_when_opened_ = is_welcome;
  for (int i = 0; i < kResets && !is_welcome; ++i) {
    send_realtime(grbl::kSoftReset);
    is_welcome = wait_for(is_there, pump, kReset_wall_s);
  }
  if (is_welcome) return refuse_old_firmware();
  throw_no_answer("GRBL controller", transport_.question(),
                  "Is this the stage's port, and is it switched on?");
}

// Jogs ($J=), their cancellation and the reports that the driver reads came with GRBL 1.1.
void GrblStage::refuse_old_firmware() const {
  const auto version = number_from_text(identity().substr(identity().rfind(' ') + 1, 3));
  if (is_hal_ || !version || *version >= 1.1) return;
  throw RigError("the stage on '" + transport_.name() + "' runs " + identity() +
                 ", which has no jogs that can be stopped. Update its firmware to GRBL 1.1");
}

void GrblStage::ask_position(const Pump& pump) {
  // Up to 30 reports in a row have work positions without their offset.
  await_report(pump, 8.0, "Set $10=1 on it, and check its firmware is GRBL 1.1 or grblHAL");
}

// Reads the settings until two readings agree: one garbled digit would falsify every move.
void GrblStage::read_settings(const Pump& pump) {
  std::map<int, double> before;
  for (int i = 0; i < kMostReadings; ++i) {
    settings_.clear();
    command("$$", pump);
    if (!settings_.empty() && settings_ == before) break;
    before = settings_;
  }
  const StageDynamics found = dynamics();
  if (!(found.steps_per_m > 0.0) || !(found.acceleration_m_s2 > 0.0) ||
      !(found.max_speed_m_s > 0.0)) {
    throw RigError(
        std::string("the stage did not report steps/mm, acceleration and largest rate ") +
        "of axis " + config_.axis + " ($" + std::to_string(100 + axis_) + ", $" +
        std::to_string(120 + axis_) + ", $" + std::to_string(110 + axis_) +
        "). Check the axis in the rig file");
  }
}

// The exchange after a welcome: settings, homing or unlocking, position.
void GrblStage::converse(const Pump& pump) {
  wait_for([] { return false; }, pump, kSettle_wall_s);
  ask_position(pump);
  if (state_ == "Hold") send_realtime(grbl::kResume);
  read_settings(pump);
  ask_position(pump);  // again, in the unit that the settings name
  if (compares_count_) {
    const std::string trouble = trouble_with_count_check(pump);
    if (!trouble.empty()) throw RigError(trouble);
  }
  if (homed_before_) {
    refuse_lost_count();
    homed_at_m_ = homed_before_->homed_at_m;
  }
  if (config_.home && !homed_at_m_) {
    home(pump);
  } else if (state_ == "Alarm") {
    was_in_alarm_ = true;
    if (keeps_locked_) return;
    command("$X", pump);
    note(clock_.now_s(), "stage_unlocked", "",
         "The stage was unlocked without homing; positions count from where it stood");
    ask_position(pump);
  }
}

void GrblStage::connect(const Pump& pump) {
  is_recovering_ = true;  // a second welcome, or an alarm from before, is no error yet
  await_welcome(pump);
  // A board that resets late sends another welcome during the exchange, which then starts again.
  for (int i = 0; i <= kResets; ++i) {
    const int n_welcomes = n_welcomes_;
    try {
      converse(pump);
      if (n_welcomes == n_welcomes_) break;
      restarts_when_opened_ = true;
    } catch (const PortHungUp&) {
      throw;
    } catch (const HomingFailed&) {
      throw;
    } catch (const RigError&) {
      if (n_welcomes == n_welcomes_ || i == kResets) throw;
    }
  }
  if (state_ != "Idle" && !(keeps_locked_ && state_ == "Alarm")) {
    throw RigError("the stage reports '" + state_ +
                   "' and is not ready. Close its door, release its switches, and retry");
  }
  exact_m_ = reported_m_;
  start_m_ = reported_m_;
  is_recovering_ = false;
}

// After a critical alarm the controller accepts only a reset; stop_hard() has already sent one.
void GrblStage::recover(const Pump& pump) {
  const bool has_reset = is_recovering_;
  const double stood_m = reported_m_;
  is_recovering_ = true;
  polls_ = false;
  forget_questions();
  const auto cut_short = std::exchange(active_, std::nullopt);  // nothing waits for it any more
  const auto is_there = [&] { return !awaits_welcome_; };
  bool is_welcome = has_reset && wait_for(is_there, pump, kReset_wall_s);
  for (int i = 0; i < kResets && !is_welcome; ++i) {
    awaits_welcome_ = true;
    pending_.clear();
    send_realtime(grbl::kSoftReset);
    is_welcome = wait_for(is_there, pump, kReset_wall_s);
  }
  if (!is_welcome) {
    throw RigError("the stage on '" + transport_.name() +
                   "' does not answer a reset: IT MAY STILL PRESS. Lift the punch by hand");
  }
  wait_for([] { return false; }, pump, kSettle_wall_s);
  ask_position(pump);
  // A reset at rest keeps state and count; a restart may be unlocked, at another count.
  const bool is_kept = state_ == "Idle" && std::abs(reported_m_ - stood_m) <= resolution_m();
  was_in_alarm_ = was_in_alarm_ || !is_kept;
  if (state_ != "Idle") {
    command("$X", pump);
    ask_position(pump);
  }
  exact_m_ = reported_m_;
  if (cut_short) hand_out(cut_short->tracker, cut_short->purpose, reported_m_);
  is_recovering_ = false;
}

// The firmware counts from power-up until it is homed.
std::string GrblStage::trouble_with_zero() const {
  if (restarts_when_opened_) {
    return "its board restarts when the port is opened and then counts from where the stage "
           "stands. A capacitor of 10 uF between RESET and GND keeps an Uno or Nano from that";
  }
  if (!has_bit(22, 0)) {
    return "homing is switched off ($22=0), so it counts from where it was switched on. Set $22=1 "
           "and home it with: viscard rig home";
  }
  if (was_in_alarm_) {
    return "it has not been homed since it was switched on, or since an alarm. "
           "Home it with: viscard rig home";
  }
  return "";
}

bool GrblStage::is_unlocked_unhomed() const {
  return was_in_alarm_ && !keeps_locked_ && has_bit(22, 0);
}

std::vector<std::string> GrblStage::advice() const {
  std::vector<std::string> advice;
  const StageDynamics found = dynamics();
  if (setting(1, 255.0) != 255.0) {
    advice.push_back("$1=" + text_from_number(setting(1, 0.0), 0) +
                     ": the motor lets go after a move and the hold is lost; set $1=255");
  }
  if (found.steps_per_m < 1600e3) {
    advice.push_back(
        "$" + std::to_string(100 + axis_) + "=" + text_from_number(found.steps_per_m * 1e-3, 0) +
        " steps/mm: a decelerating stop needs 7.5 steps, " +
        text_from_number(7.5e6 / found.steps_per_m, 1) + " um, and it moves no slower than " +
        text_from_number(found.min_speed_m_s * 1e3, 3) +
        " mm/s; use microstepping for at least 1600");
  }
  if (found.acceleration_m_s2 < 0.1) {
    advice.push_back("$" + std::to_string(120 + axis_) + "=" +
                     text_from_number(found.acceleration_m_s2 * 1e3, 0) +
                     " mm/s2: stops and ramps are slow; set at least 100");
  }
  if (setting(21, 0.0) == 0.0) {
    advice.push_back("$21=0: no hard limits; limit switches and $21=1 protect cell and stage");
  }
  return advice;
}

}  // namespace viscard
