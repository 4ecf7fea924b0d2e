#pragma once

#include "models/experiment/emulated_specimen.h"
#include "models/experiment/rig_config.h"
#include "rig/emulator/emulated_controller.h"

#include <optional>
#include <string>
#include <string_view>

namespace viscard {

// Behaviour of real controllers that a driver must cope with. Times on the emulated clock.
struct SmcHabits {
  bool has_reference = true;       // false: not homed since it was switched on
  bool loses_power = false;        // a restart cuts the supply; otherwise only the port is opened
  bool is_pp = false;              // a stepper: SU? is refused
  bool knows_target = true;        // PA? is answered
  bool limit_keeps_motor = false;  // a limit leaves its bit; otherwise a following error
  bool fails_to_home = false;
  char stale_error = '@';  // left by another program
  double jerk_time_s = 0.005;
  double lowest_mm = -25.0, highest_mm = 25.0;
  double deaf_after_command_s = 0.05;  // a line that comes sooner is lost, except ST
  int hold_every = 0;                  // every n-th line is followed by XOFF, and XON 0.2 s later
  AnswerHabits answers = {.delay_s = 0.01};
};

// A Newport SMC100 as a host sees it on the wire (rig/protocols/smc_protocol.h gives the sources).
// One encoder count or microstep is one step of the truth.
class EmulatedSmc final : public EmulatedController {
 public:
  EmulatedSmc(const EmulatedTruth& truth, const StageConfig& stage, const SmcHabits& habits);

  void reset(double time_s) override;
  void receive(std::string_view bytes, double time_s) override;
  void tick(double time_s) override;
  void hit_limit(double time_s) override;

 private:
  void take_line(std::string_view text, double time_s);
  std::optional<std::string> answer_to(std::string_view letters, double time_s);
  void obey(std::string_view letters, std::optional<double> value, double time_s);
  void move(double to_mm, double time_s);
  char refusal() const;        // of a move in this state; '@' if it is allowed
  void update(double time_s);  // the state after a motion that has ended
  double position_mm(double time_s) const;

  SmcHabits habits_;
  double steps_per_m_;
  double toward_;
  std::string address_;
  double speed_mm_s_, largest_speed_mm_s_, acceleration_mm_s2_;
  double target_mm_ = 0.0;
  double offset_mm_ = 0.0;  // of the counter, after the supply was cut
  unsigned state_, faults_ = 0;
  char error_;
  bool has_started_ = false;
  double deaf_until_s_ = -1.0;
  double held_until_s_ = -1.0;
  std::size_t n_bytes_held_ = 0;
  int n_lines_ = 0;
  std::string begun_;
};

}  // namespace viscard
