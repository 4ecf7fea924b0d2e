#pragma once

#include "models/experiment/emulated_specimen.h"
#include "rig/emulator/emulated_controller.h"

#include <deque>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace viscard {

// Behaviour of real controllers that a driver must cope with. Times on the emulated clock.
struct GrblHabits {
  bool is_hal = false;                 // grblHAL's welcome and extra fields
  bool has_empty_eeprom = false;       // sends error:7 and its settings before the first welcome
  bool is_homing_enabled = false;      // $22=1: boots into Alarm
  bool is_homed = false;               // before power-up: its count goes on, and it boots into Idle
  double counts_m = 0.0;               // where it counts itself on the bench at power-up, if homed
  bool is_unlocked_at_boot = false;    // built without HOMING_INIT_LOCK: boots into Idle
  int fail_homing_number = 0;          // the n-th homing cycle ends with homing_alarm and a welcome
  int homing_alarm = 8;                // 8: it stays on its switch; 9: it finds none
  bool homes_all_axes = false;         // the build knows no $HX, $HY, $HZ
  bool has_hard_limits = false;        // $21=1: the switch at home stops the stage with an alarm
  int lose_status_every = 0;           // every n-th '?' gets no answer
  double ok_delay_s = 0.0;             // from a line to its answer
  bool answers_twice = false;          // every ok is sent twice
  bool reports_work_position = false;  // $10=0
  bool reports_inches = false;         // $13=1
  double soft_limit_mm = 0.0;          // $20=1 and $130-132: jogs outside of 0 to minus this fail
  double status_delay_s = 0.0;         // from '?' to its report
  bool reports_twice = false;          // every '?' is answered by two lines
  bool has_startup_block = false;      // ">G54G21:ok" after the welcome
  int lose_ok_number = 0;              // the n-th ok is never sent
  int refuse_jog_number = 0;           // the n-th jog is answered by error:15
  int misread_jog_number = 0;          // the n-th jog goes 1 mm further than asked for
  int ends_short_number = 0;           // the n-th jog stops half way and reports Idle
  bool alarms_again = false;           // a limit switch that opens again raises another alarm
  bool holds_after_cancel = false;     // after a jog cancel it takes no line at Idle until '~'
  bool never_rests = false;            // reports Jog long after a move has ended
  bool refuses_unlock = false;         // $X is answered by error:13 (the safety door is open)
  double true_speed = 1.0;             // the board's clock over the one it should have
  bool has_avr_timer = true;           // periods of its timer are whole cycles; not with is_hal
};

// Where the stage stands when it has homed, from its position at power-up.
inline constexpr double kHomeAt_m = -3e-3;

// A GRBL controller as a host sees it on the wire, with the states, answers, alarms and silences of
// GRBL 1.1 (gnea/grbl doc/markdown/interface.md). Each of several queued moves ends at rest. The
// real planner does not stop between collinear moves, but no driver here queues more than one.
class EmulatedGrbl final : public EmulatedController {
 public:
  EmulatedGrbl(const EmulatedTruth& truth, char axis, int toward_specimen,
               const GrblHabits& habits);

  // Drops everything pending and prepares the welcome.
  void reset(double time_s) override;
  void receive(std::string_view bytes, double time_s) override;
  void tick(double time_s) override;
  void hit_limit(double time_s) override;

 private:
  struct QueuedMove {
    double to_m, speed_m_s;
  };
  void realtime(char c, double time_s);
  void line(std::string text, double time_s);
  void dollar(const std::string& text, double time_s);
  void jog(std::string_view words, double time_s);
  void home(double time_s, bool is_single);
  void end_homing(double time_s);
  double home_m() const;
  double switch_m() const;
  double home_origin_m(double at_m) const;
  std::optional<double> meets_switch_at_s(double time_s) const;
  void set(std::string_view words, double time_s);
  void soft_reset(double time_s);
  void begin_alarm(double time_s);
  void end_alarm();
  void take(std::string text, double time_s);
  void report(double time_s);
  void answer(double time_s, const std::string& text);
  void ok(double time_s);
  void error(double time_s, int code);
  std::string status(double time_s);
  std::string settings_text() const;
  void welcome();
  void load_axis_settings();

  double least_speed_m_s() const;
  double true_speed_m_s(double asked_m_s) const;
  double machine_mm(double bench_m) const;
  double bench_m(double machine_mm) const;

  GrblHabits habits_;
  std::size_t axis_;               // 0 1 2
  double toward_;                  // sign of machine motion toward the specimen
  double machine_origin_m_ = 0.0;  // bench position of machine zero
  std::map<int, double> settings_;
  double steps_per_m_ = 0.0, acceleration_m_s2_ = 0.0, max_rate_m_s_ = 0.0;
  std::deque<QueuedMove> queue_;
  std::string state_ = "Idle";
  bool is_silent_ = false;              // after a critical alarm, until the reset
  std::optional<double> deaf_until_s_;  // while an alarm is being reported, all bytes are lost
  bool is_cancelling_ = false;          // a jog that is being stopped
  bool is_eeprom_dumped_ = false;
  std::string begun_line_;
  DelayedBytes late_reports_;
  std::deque<std::string> held_lines_;
  bool is_held_ = false;       // takes no line although it reports Idle
  bool is_on_switch_ = false;  // a limit switch was hit and has not opened again
  double ticked_s_ = 0.0;
  int n_status_ = 0, n_oks_ = 0, n_jogs_ = 0, n_homings_ = 0;
};

}  // namespace viscard
