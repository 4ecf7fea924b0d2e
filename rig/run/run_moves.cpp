// The moves of a session, and how they are watched: the age of the readings, and the delays of this
// computer.
#include "models/maths/text_of_number.h"
#include "rig/run/run_session.h"

#include <algorithm>
#include <limits>

namespace viscard {
namespace {

constexpr double kFresh_wall_s = 1.0;  // longest wait for a reading that is young enough
constexpr double kLongestStep_m = 25e-6;
constexpr double kSureSigmas = 40.0;  // of the noise: a rise that others are compared with
// At usual speeds the force rises by less than its reserve between soft limit and capacity.
constexpr double kUnwatched_wall_s = 0.4;
constexpr const char* kByHand = "lift";  // purpose of the lifts before a test, and by hand

}  // namespace

// Only time spent listening counts: what was sent before a pause of this program has been read.
double RunSession::age_s() const {
  return devices_.load_cell().listened_at_s() - readings_.newest_made_s();
}

void RunSession::check_age() {
  if (!is_pressing_ || !stage().is_moving()) return;
  const double allowed_s = ages_.allowed_s(load_cell().period_s());
  const double age = age_s();
  if (age <= allowed_s) return;
  devices_.stop_hard();
  is_pressing_ = false;
  event("limit", "old",
        "The newest reading was " + text_from_number(age, 3) +
            " s old while the stage pressed, which may be " + text_from_number(allowed_s, 3) +
            " s: it was reset");
  throw_too_old("while the stage was pressing; it was stopped at once");
}

std::string RunSession::lateness_text(double within_wall_s) const {
  const double late_s = clock_.lateness().recent_s(within_wall_s);
  if (late_s <= 0.0) return "";
  return "this computer was late by " + text_from_number(late_s, 2) +
         " s, because other programs kept it busy or this one was frozen. Close these programs, or "
         "start viscard with priority (chrt -f 50 viscard ...), then start the run again";
}

// Everything received in the meantime has been read and judged before this.
void RunSession::check_lateness() {
  const HostLateness& host = clock_.lateness();
  if (host.n_long() == n_late_) return;
  n_late_ = host.n_long();
  const double late_s = host.newest_long_s();
  longest_late_s_ = std::max(longest_late_s_, late_s);
  const bool was_pressing = is_pressing_ && stage().is_moving();
  event("computer_late", text_from_number(late_s, 3),
        "This computer was late by " + text_from_number(late_s, 2) + " s and watched nothing" +
            (stage().is_moving() ? " while the stage moved" : ""));
  if (!is_guarded_ || !was_pressing || late_s < kUnwatched_wall_s) return;
  throw ComputerLate("nobody watched the force while the stage was pressing: " + lateness_text());
}

void RunSession::throw_too_old(const std::string& what) const {
  if (const std::string late = lateness_text(); !late.empty()) {
    throw ComputerLate("the readings of the load cell were too old " + what + ": " + late);
  }
  const LoadCell& cell = devices_.load_cell();
  const double age = age_s();
  if (cell.listened_at_s() - cell.last_arrival_s() > 0.5 * age) {
    throw ReadingsTooOld("the load cell fell silent " + what +
                         ". Check the amplifier and its cable, then start the run again");
  }
  throw ReadingsTooOld(
      "the newest reading of the load cell was " + text_from_number(age, 2) + " s old " + what +
      ". Its line falls behind (too slow for the lines that are sent, or a radio link), or a "
      "converter without a clock is slower than expected_rate in the rig file. Measure both with: "
      "viscard rig check");
}

void RunSession::expect_stiffness(double stiffness_N_m) {
  stiffness_N_m_ = std::max(stiffness_N_m_, stiffness_N_m);
}

// False if a reading is still missing after so much time spent listening.
bool RunSession::pump_while(const std::function<bool()>& is_waiting, double listened_wall_s) {
  const double until_s = clock_.awake_s() + listened_wall_s;
  while (is_waiting()) {
    if (clock_.awake_s() > until_s) return false;
    pump();
  }
  return true;
}

bool RunSession::move(double to_m, double speed_m_s, const std::string& purpose,
                      std::optional<double> stop_above_N) {
  const double most_N = stop_above_N.value_or(std::numeric_limits<double>::infinity());
  readings_.watch(-most_N, most_N);
  if (to_m > stage().position_m()) {
    press(to_m, speed_m_s, purpose, stop_above_N);
  } else {
    move_once(to_m, speed_m_s, purpose, stop_above_N);
  }
  readings_.stop_watching();
  return readings_.has_exceeded();
}

bool RunSession::lift(double to_m, double speed_m_s, const std::string& purpose, double limit_N) {
  // Forces count from the tare, and this was made while the punch may have pressed, or pulled: it
  // then comes free by a force that rises to zero.
  readings_.watch(-(std::max(0.0, readings_.tare_N()) + limit_N),
                  limit_N + std::max(0.0, -readings_.tare_N()));
  move_once(to_m, speed_m_s, purpose, limit_N);
  readings_.stop_watching();
  return readings_.has_exceeded();
}

// A move toward the specimen.
void RunSession::press(double to_m, double speed_m_s, const std::string& purpose,
                       std::optional<double> stop_above_N) {
  const StageDynamics dynamics = stage().dynamics();
  const double limit_N = std::min(guard_.soft_limit_N(), stop_above_N.value_or(1e300));
  ages_.begin_move(limit_N, stiffness_N_m_ * std::max(speed_m_s, dynamics.min_speed_m_s));
  const double period_s = load_cell().period_s();
  const bool is_in_steps = ages_.needs_steps(period_s);
  const double step_m = is_in_steps ? std::max(kLongestStep_m, 1.01 / dynamics.steps_per_m) : 1e300;
  const auto is_old = [&] { return age_s() > ages_.allowed_s(period_s); };
  press_speed_m_s_ = std::max(speed_m_s, dynamics.min_speed_m_s);
  pressed_from_m_ = stage().position_m();
  pressed_from_N_ = readings_.sound_force_N(noise_N_);
  places_.clear();
  // Only from the contact: what earlier presses have left in the specimen is not known.
  const bool is_first = follow_.stiffness_N_m > 0.0 && pressed_from_m_ <= follow_.contact_m;
  rise_.begin(follow_.contact_m, is_first ? to_m - follow_.contact_m : 0.0,
              1.0 / dynamics.steps_per_m, std::max(kSureSigmas * noise_N_, judged_N()));
  while (!readings_.has_exceeded() && stage().position_m() < to_m) {
    await_change();
    if (!pump_while(is_old, kFresh_wall_s)) throw_too_old("before the stage was to press");
    if (readings_.has_exceeded()) return;
    is_pressing_ = !is_in_steps;
    const double next_m = std::min(to_m, stage().position_m() + step_m);
    move_once(next_m, speed_m_s, purpose, stop_above_N);
    is_pressing_ = false;
    if (next_m == to_m) return;
    await_reading_after(clock_.now_s());
    judge_press(stage().position_m());
  }
}

void RunSession::move_once(double to_m, double speed_m_s, const std::string& purpose,
                           std::optional<double> stop_above_N) {
  const bool is_away = to_m < stage().position_m();
  if (is_away) {
    // Before the tare of a test the punch may have pulled.
    const double least_N =
        std::max(least_start_N(), purpose == kByHand ? -readings_.tare_N() : 0.0);
    readings_.watch_rise(
        {std::max(clock_.now_s(), pressed_until_s_), least_N, purpose == away_purpose_});
  } else {
    readings_.forget_rise();
    press_ended_s_ = std::numeric_limits<double>::infinity();
  }
  away_purpose_ = is_away ? purpose : "";
  hold_.end();
  stage().begin_move(to_m, speed_m_s, purpose);
  has_moved_ = true;
  const bool has_begun = stage().is_moving();
  bool is_stopping = false;
  while (stage().is_moving()) {
    pump();
    if (readings_.has_exceeded() && !is_stopping && stage().is_moving()) {
      stage().stop_soft();
      is_stopping = true;
      is_pressing_ = false;  // it comes to rest without more readings
    }
  }
  if (is_away) {
    readings_.end_rise(clock_.now_s());
  } else {
    press_ended_s_ = clock_.now_s();
    pressed_until_s_ =
        clock_.now_s() + press_seen_after_s(load_cell().period_s(), clock_.from_wall_s(1.0));
  }
  if (has_begun) lag_s_ = std::max(lag_s_, stage().lag_s());
  // Readings made before standstill may still be on their way.
  if (stop_above_N) await_reading_after(clock_.now_s());
}

void RunSession::await_reading_after(double time_s) {
  readings_.collect_from(time_s);
  const bool has_come = pump_while([&] { return readings_.n_collected() == 0; }, kFresh_wall_s);
  readings_.stop_collecting();
  if (!has_come) throw_too_old("after the stage had come to rest");
}

}  // namespace viscard
