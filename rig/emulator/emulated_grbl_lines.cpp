// The lines of EmulatedGrbl: commands that begin with "$", and status reports.
#include "models/maths/text_of_number.h"
#include "rig/emulator/emulated_grbl.h"
#include "rig/protocols/grbl_protocol.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace viscard {
namespace {

constexpr int kPlannerBlocks = 15;

// The words after "$J=", or the error code for them.
struct JogWords {
  int error = 0;
  double scale_mm = 1.0;
  bool is_relative = false;
  std::optional<double> target;
  std::optional<double> feed;
};

JogWords parse_jog(std::string_view words, char axis) {
  JogWords jog;
  const auto failed = [&](int error) {
    jog.error = error;
    return jog;
  };
  while (!words.empty()) {
    const char letter = words.front();
    if (letter < 'A' || letter > 'Z') return failed(1);
    words.remove_prefix(1);
    const std::size_t end = std::min(words.find_first_not_of("+-.0123456789"), words.size());
    const auto number = number_from_text(words.substr(0, end));
    if (!number) return failed(2);
    words.remove_prefix(end);
    if (letter == 'G') {
      if (*number == 20.0) jog.scale_mm = 25.4;
      if (*number == 91.0) jog.is_relative = true;
      const bool is_known = *number == 20.0 || *number == 21.0 || *number == 53.0 ||
                            *number == 90.0 || *number == 91.0;
      if (!is_known) return failed(16);
    } else if (letter == axis) {
      jog.target = *number;
    } else if (letter == 'F') {
      jog.feed = *number;
    } else if (letter != 'X' && letter != 'Y' && letter != 'Z') {
      return failed(16);
    }
  }
  if (!jog.feed || !(*jog.feed > 0.0)) return failed(22);
  return jog;
}

}  // namespace

void EmulatedGrbl::dollar(const std::string& text, double time_s) {
  if (text.rfind("$J=", 0) == 0) return jog(std::string_view(text).substr(3), time_s);
  if (text == "$X") {
    if (habits_.refuses_unlock) return error(time_s, 13);
    if (state_ == "Alarm") {
      output_ += "[MSG:Caution: Unlocked]\r\n";
      state_ = "Idle";
    }
    return ok(time_s);
  }
  if (text == "$H") return home(time_s, false);
  if (text == std::string("$H") + "XYZ"[axis_]) return home(time_s, true);
  if (text == "$G") {
    output_ += "[GC:G0 G54 G17 G21 G90 G94 M5 M9 T0 F0 S0]\r\n";
    return ok(time_s);
  }
  if (motion_.is_moving(time_s)) return error(time_s, 8);
  if (text == "$$" || text == "$#" || text == "$I") {
    if (text == "$$") output_ += settings_text();
    if (text == "$#") output_ += "[G54:0.000,0.000,0.000]\r\n[TLO:0.000]\r\n";
    if (text == "$I" && habits_.is_hal) {
      output_ += "[VER:1.1f.20240101:]\r\n[OPT:VNM";
      output_ += habits_.homes_all_axes ? "" : "H";
      output_ += "L+,100,1024,3,0]\r\n[FIRMWARE:grblHAL]\r\n";
    } else if (text == "$I") {
      output_ += std::string("[VER:1.1h.20190830:]\r\n[OPT:V") +
                 (habits_.homes_all_axes ? "" : "H") + ",15,128]\r\n";
    }
    return ok(time_s);
  }
  if (text.find('=') != std::string::npos) return set(std::string_view(text), time_s);
  error(time_s, 3);
}

void EmulatedGrbl::set(std::string_view words, double time_s) {
  const auto setting = parse_grbl_setting(words);
  if (!setting || settings_.count(setting->number) == 0) return error(time_s, 3);
  if (setting->value < 0.0) return error(time_s, 4);
  settings_[setting->number] = setting->value;
  load_axis_settings();
  ok(time_s);
}

std::string EmulatedGrbl::settings_text() const {
  std::string text;
  for (const auto& [number, value] : settings_) {
    const bool is_integer = number < 100 && number != 11 && number != 12 && number != 24 &&
                            number != 25 && number != 27;
    text +=
        "$" + std::to_string(number) + "=" + text_from_number(value, is_integer ? 0 : 3) + "\r\n";
  }
  return text;
}

// The larger of 1 mm/min and the speed at the longest time between steps that an AVR's timer makes
// (gnea/grbl config.h and stepper.c; rig/protocols/README.md).
double EmulatedGrbl::least_speed_m_s() const {
  return habits_.is_hal ? 0.0 : std::max(1e-3 / 60.0, 16e6 / (8.0 * 65535.0) / steps_per_m_);
}

void EmulatedGrbl::jog(std::string_view words, double time_s) {
  if (state_ == "Alarm") return error(time_s, 9);
  if (state_ != "Idle" && state_ != "Jog") return error(time_s, 8);
  const JogWords asked = parse_jog(words, "XYZ"[axis_]);
  if (asked.error != 0) return error(time_s, asked.error);
  if (++n_jogs_ == habits_.refuse_jog_number) return error(time_s, 15);
  if (asked.target) {
    const double last_m = queue_.empty() ? motion_.end_position_m() : queue_.back().to_m;
    const double base_mm = asked.is_relative ? machine_mm(last_m) : 0.0;
    const bool is_misread = n_jogs_ == habits_.misread_jog_number;
    const double to_mm = base_mm + *asked.target * asked.scale_mm + (is_misread ? toward_ : 0.0);
    // Checked whether the stage is homed or not (gnea/grbl jog.c).
    if (settings_[20] != 0.0 && (to_mm > 0.0 || to_mm < -settings_[130])) {
      return error(time_s, 15);
    }
    const double share = n_jogs_ == habits_.ends_short_number ? 0.5 : 1.0;
    const double asked_m_s = std::min(*asked.feed * asked.scale_mm / 60e3, max_rate_m_s_);
    const double speed_m_s = std::max(asked_m_s, least_speed_m_s());
    queue_.push_back({last_m + share * (bench_m(to_mm) - last_m), speed_m_s});
    state_ = "Jog";
    tick(time_s);
    if (is_silent_) return;
  }
  ok(time_s);
}

void EmulatedGrbl::home(double time_s, bool is_single) {
  if (settings_[22] == 0.0) return error(time_s, 5);
  if (motion_.is_moving(time_s)) return error(time_s, 8);
  if (is_single && habits_.homes_all_axes) return error(time_s, 3);
  state_ = "Home";
  ++n_homings_;
  is_on_switch_ = false;
  motion_.start(time_s, home_m(), settings_[25] / 60e3, acceleration_m_s2_);
}

// A cycle that fails resets the controller: no ok, an alarm, then a welcome in the alarm state
// (gnea/grbl limits.c and main.c; grblHAL alike).
void EmulatedGrbl::end_homing(double time_s) {
  if (n_homings_ == habits_.fail_homing_number) {
    state_ = "Alarm";
    output_ += "ALARM:" + std::to_string(habits_.homing_alarm) + "\r\n";
    return begin_alarm(time_s);
  }
  machine_origin_m_ = home_origin_m(motion_.end_position_m());
  state_ = "Idle";
  ok(time_s);
}

std::string EmulatedGrbl::status(double time_s) {
  std::array<double, 3> position_mm{};
  const double here_m = std::round(motion_.position_m(time_s) * steps_per_m_) / steps_per_m_;
  position_mm[axis_] = machine_mm(here_m);
  const std::string name = state_ == "Hold" ? "Hold:0" : state_;
  std::string text = "<" + name + (settings_[10] == 0.0 ? "|WPos:" : "|MPos:");
  for (std::size_t i = 0; i < 3; ++i) {
    text += (i > 0 ? "," : "") + (settings_[13] != 0.0 ? text_from_number(position_mm[i] / 25.4, 4)
                                                       : text_from_number(position_mm[i], 3));
  }
  if (settings_[10] >= 2.0 || habits_.is_hal)
    text += "|Bf:" + std::to_string(kPlannerBlocks) + ",128";
  text += "|FS:" + text_from_number(std::abs(motion_.velocity_m_s(time_s)) * 60e3, 0) + ",0";
  const int every = motion_.is_moving(time_s) ? 30 : 10;
  if (n_status_ % every == 1) {
    text += "|WCO:0.000,0.000,0.000";
  } else if (n_status_ % every == 2) {
    text += "|Ov:100,100,100";
  }
  if (habits_.is_hal && n_status_ % every == 3) text += "|A:|TLR:0";
  return text + ">\r\n";
}

}  // namespace viscard
