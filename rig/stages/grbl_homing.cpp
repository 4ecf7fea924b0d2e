// Homing of GrblStage, and the comparison of its count with the limit switch.
#include "models/maths/text_of_number.h"
#include "rig/stages/grbl_stage.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace viscard {
namespace {

constexpr double kAxisHomed_wall_s = 180.0;
constexpr double kBack_m_s = 1e-3;      // to where it was homed
constexpr double kTouch_m_s = 0.1e-3;   // to the switch: so slow that it stops within a step
constexpr double kPastSwitch = 2.0;     // of the pull-off: the longest way to the switch
constexpr int kHardLimit = 1;           // the alarm of a limit switch
constexpr double kUsualPullOff_mm = 1;  // $27 of gnea/grbl defaults.h
constexpr double kStepsDoubted = 2.0;

}  // namespace

bool GrblStage::has_bit(int number, int bit) const {
  return (static_cast<long>(setting(number, 0.0)) >> bit & 1) != 0;
}

void GrblStage::plan_count_check(std::optional<HomedStage> before) {
  compares_count_ = true;
  homed_before_ = before;
}

// Between two counts of the same place, both reported with as many decimals.
double GrblStage::count_slack_m() const {
  const double step_m = 1.0 / dynamics().steps_per_m;
  return kStepsDoubted * step_m + 2.0 * (resolution_m() - step_m);
}

// The firmware keeps its count over a soft reset, not over a restart: that begins in an alarm, or
// at another count if its build does not lock it (grbl/config.h, HOMING_INIT_LOCK).
void GrblStage::refuse_lost_count() const {
  const std::string since = " since it was homed at the beginning of the series";
  const std::string next =
      ". Start the series again, with --resume for the captures that are left: it homes the stage "
      "first";
  if (state_ == "Alarm") {
    throw RigError("the stage's controller has restarted" + since + ", so its count is lost" +
                   next);
  }
  if (std::abs(reported_m_ - homed_before_->stood_at_m) <= count_slack_m()) return;
  const auto in_mm = [](double position_m) {
    return text_from_number(position_m * 1e3, 3) + " mm";
  };
  throw RigError("the stage's controller counts " + in_mm(reported_m_) + ", but " +
                 in_mm(homed_before_->stood_at_m) +
                 " at the end of the run before: it has restarted" + since +
                 ", or something else has moved it, so its count does not hold" + next);
}

// A build that homes all axes at once would move the punch over the specimens.
std::string GrblStage::trouble_with_count_check(const Pump& pump) {
  const std::string letter(1, config_.axis);
  const std::string remedy = ", or set home = false under [stage] of the rig file";
  const auto refused = [&](const std::string& why, const std::string& what) {
    return "home = true cannot compare the stage's count after a run: " + why + ". " + what +
           remedy;
  };
  if (!has_bit(22, 0)) return refused("homing is switched off ($22=0)", "Set $22=1");
  if (!has_bit(21, 0)) {
    return refused("its limit switch does not stop it ($21=0)", "Set $21=1");
  }
  if (has_bit(20, 0)) {
    return refused("soft limits end its way before the switch ($20=1)", "Set $20=0");
  }
  // $23 has a bit for each axis that homes to its negative end.
  if ((has_bit(23, axis_) ? -1.0 : 1.0) * toward_ > 0.0) {
    return refused("axis " + letter + " homes toward the specimen ($23, toward_specimen)",
                   "Put its switch at the other end");
  }
  build_options_.reset();
  command("$I", pump);
  if (build_options_ && build_options_->find(kGrblHomesOneAxis) != std::string::npos) return "";
  return refused("this build of the firmware homes all axes or none",
                 is_hal_ ? "Set bit 1 of $22 on it"
                         : "Build it with HOMING_SINGLE_AXIS_COMMANDS (grbl/config.h)");
}

bool GrblStage::is_homing() const {
  return !pending_.empty() && pending_.front().line.rfind("$H", 0) == 0;
}

// The firmware ends a failed cycle by an alarm and restarts itself, which is no ok (gnea/grbl
// limits.c, limits_go_home; main.c).
void GrblStage::throw_homing_failed(const std::string& how) {
  throw HomingFailed("the homing of the stage ended " + how +
                     ". The stage is not homed and stays locked. Look at its limit switch and at "
                     "what is in its way, then home it again with: viscard rig home");
}

void GrblStage::home(const Pump& pump) {
  polls_ = false;  // while homing, no '?' is answered
  forget_questions();
  exact_m_.reset();
  homed_at_m_.reset();
  was_in_alarm_ = true;  // until the cycle has ended well
  try {
    command(compares_count_ ? std::string("$H") + config_.axis : "$H", pump, kAxisHomed_wall_s);
  } catch (const HomingFailed&) {
    throw;
  } catch (...) {
    try {
      stop_hard();                 // nothing else ends a homing cycle
    } catch (const PortHungUp&) {  // then the error before has named it
    }
    throw;
  }
  ask_position(pump);
  exact_m_ = reported_m_;
  homed_at_m_ = reported_m_;
  was_in_alarm_ = false;
}

void GrblStage::go(double to_m, double speed_m_s, const Pump& pump) {
  begin_move(to_m, speed_m_s, "home");
  while (active_) pump();
}

// The count at which the switch stops the stage. The firmware keeps it through the alarm and the
// reset (gnea/grbl main.c clears sys_position only at power-up).
double GrblStage::touch_switch(const Pump& pump) {
  const double pull_off_m = setting(27, kUsualPullOff_mm) * 1e-3;
  alarm_code_ = 0;
  try {
    if (*homed_at_m_ < position_m())
      go(*homed_at_m_, kBack_m_s, pump);  // never toward the specimen
    go(*homed_at_m_ - kPastSwitch * pull_off_m, kTouch_m_s, pump);
  } catch (const StageAlarm&) {
    if (alarm_code_ != kHardLimit) throw;
    recover(pump);
    return position_m();
  }
  throw RigError("the stage passed the place of its limit switch by " +
                 text_from_number((kPastSwitch - 1.0) * pull_off_m * 1e3, 1) +
                 " mm and was not stopped. Check the switch and its cable; or it has lost "
                 "more than that in steps while it lifted");
}

std::optional<CountCheck> GrblStage::check_count(const Pump& pump) {
  if (!compares_count_ || !homed_at_m_) return std::nullopt;
  const double counted_m = touch_switch(pump);
  home(pump);
  const double found_m = touch_switch(pump);
  home(pump);  // leaves the switch
  const double off_m = counted_m - found_m;
  return CountCheck{off_m, off_m * dynamics().steps_per_m, count_slack_m()};
}

}  // namespace viscard
