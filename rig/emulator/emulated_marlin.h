#pragma once

#include "models/experiment/emulated_specimen.h"
#include "rig/emulator/emulated_controller.h"

#include <deque>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

namespace viscard {

// Behaviour of real boards that a driver must cope with. Times on the emulated clock; numbers count
// from 1, and 0 means never.
struct MarlinHabits {
  std::string firmware = "Marlin 2.1.2 (Feb  1 2023 12:00:00)";
  bool talks_at_start = true;          // false: native USB, the host misses "start"
  bool sends_ok_after_resend = false;  // by version
  bool sends_advanced_ok = false;      // "ok N5 P15 B3"
  bool has_emergency_parser = true;    // M410 acts while its line arrives
  bool has_realtime_reports = true;    // M114_REALTIME: M114 R reports the motors, not the plan
  bool waits_in_m114 = false;          // Marlin 1.1, or M114_LEGACY: answers at rest
  bool needs_home = false;             // moves are answered with ok and not made before G28
  double homing_s = 0.0;               // at least, with "busy" meanwhile
  bool restarts_in_homing = false;     // at its end, without an ok
  int halt_number = 0;                 // kill() instead of this line: silent until a reset
  bool makes_short_moves = false;      // of fewer than 6 steps; else they join the next one
  double highest_m = std::numeric_limits<double>::infinity();  // a soft limit, on the bench
  double lowest_m = -std::numeric_limits<double>::infinity();
  double answer_delay_s = 0.0;
  int lose_answer_every = 0;  // every n-th ok is not sent
  int garble_line_every = 0;  // every n-th line arrives with a wrong byte
  int lose_line_every = 0;    // every n-th line never arrives
  int lose_stop_number = 0;   // this M410 never arrives
  double stop_delay_s = 0.0;  // without an emergency parser
  double stopped_s = 1.0;     // M410 is answered only then: twice, without an emergency parser
  double true_speed = 1.0;    // the board's clock over the one it should have
};

// A board with Marlin firmware as a host sees it on the wire (rig/protocols/marlin_protocol.h gives
// the sources). Its planner joins moves in line if the next one is known before the last one begins,
// and waits up to 0.1 s for the third one before it begins.
class EmulatedMarlin final : public EmulatedController {
 public:
  EmulatedMarlin(const EmulatedTruth& truth, char axis, int toward_specimen,
                 const MarlinHabits& habits);

  void reset(double time_s) override;
  void receive(std::string_view bytes, double time_s) override;
  void tick(double time_s) override;
  void hit_limit(double time_s) override;

 private:
  struct Block {
    double to_m, speed_m_s;
  };
  void line(std::string text, double time_s);
  // The command of a numbered line, or nothing if it was refused.
  std::optional<std::string> checked(const std::string& text, double time_s);
  void refuse(const std::string& error, double time_s);
  bool is_blocked(double time_s);
  void obey(const std::string& command, double time_s);
  void move(const std::string& command, double time_s);
  void add_block(Block block, double time_s);
  void begin_blocks(double time_s);
  void stop(double time_s);
  void quick_stop(double time_s);
  void say(const std::string& text, double time_s);
  void ok(double time_s);
  std::string position(double at_m) const;
  std::string settings() const;
  double mm(double bench_m) const { return toward_ * (bench_m - origin_m_) * 1e3; }
  double end_m() const;

  MarlinHabits habits_;
  char axis_;
  double toward_, step_m_, max_speed_m_s_, acceleration_m_s2_;
  double origin_m_ = 0.0;       // bench position of count 0
  double zero_m_ = 0.0;         // bench position of position 0 (G92)
  double speed_m_s_ = 1e-3;     // F
  std::deque<Block> blocks_;    // not begun
  double last_begins_m_ = 0.0;  // where the last of the joined moves begins
  double joined_m_s_ = 0.0;     // their speed
  double deliver_s_ = 0.0;
  std::deque<std::string> commands_;
  std::string begun_;
  long last_number_ = 0;
  bool is_homed_ = false, is_homing_ = false;
  double home_until_s_ = 0.0;
  bool is_halted_ = false;
  std::optional<double> stop_due_s_;
  double deaf_until_s_ = 0.0;     // lines are taken before, but not made
  bool is_stop_flagged_ = false;  // a stop that came meanwhile, with an emergency parser
  bool answers_stop_ = false;     // when that time is over, without one
  double busy_s_ = 0.0;
  int n_lines_ = 0, n_oks_ = 0, n_stops_ = 0, n_starts_ = 0;
};

}  // namespace viscard
