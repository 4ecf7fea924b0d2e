#pragma once

#include "models/experiment/emulated_specimen.h"
#include "models/experiment/rig_config.h"
#include "rig/emulator/emulated_controller.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace viscard {

// Behaviour of real controllers that a driver must cope with. Times on the emulated clock.
struct PiHabits {
  bool has_reference = true;        // false: not referenced since it was switched on
  bool loses_power = false;         // a restart cuts the supply; otherwise only the port is opened
  bool lists_two_axes = false;      // every answer of an axis has a line for a second one
  bool comes_on_target = true;      // false: ONT? stays 0, as under a load
  bool limit_keeps_servo = false;   // a limit leaves error 216; otherwise a motion error, 1024
  bool has_parameters = true;       // false: SPA? is an unknown command
  int stale_error = 0;              // left by another program
  int counts_beside_target = 0;     // where the stage rests
  double deceleration_ratio = 1.0;  // DEC over ACC
  double lowest_mm = -25.0, highest_mm = 25.0;
  AnswerHabits answers;
};

// A PI controller of one axis with GCS 2 as a host sees it on the wire (rig/protocols/pi_protocol.h
// gives the sources). One encoder count is one step of the truth.
class EmulatedPi final : public EmulatedController {
 public:
  EmulatedPi(const EmulatedTruth& truth, const StageConfig& stage, const PiHabits& habits);

  void reset(double time_s) override;
  void receive(std::string_view bytes, double time_s) override;
  void tick(double time_s) override { output_ += answers_.take_due(time_s); }
  void hit_limit(double time_s) override;

 private:
  void take_byte(char byte, double time_s);
  void take_line(std::string_view text, double time_s);
  // True if the words are for this controller; removes the address.
  bool is_addressed(std::vector<std::string>& words);
  std::optional<std::string> answer_to(const std::vector<std::string>& words, double time_s);
  void obey(const std::vector<std::string>& words, double time_s);
  void set(const std::string& verb, double value, double time_s);
  void move(double to_mm, double time_s);
  void answer(const std::string& text, double time_s);
  double position_mm(double time_s) const;
  bool is_homing(double time_s) const { return is_homing_ && motion_.is_moving(time_s); }

  PiHabits habits_;
  double steps_per_m_;
  double toward_;
  int device_;
  std::string axis_;
  double speed_mm_s_, largest_speed_mm_s_, acceleration_mm_s2_, deceleration_mm_s2_;
  double target_mm_ = 0.0;
  double offset_mm_ = 0.0;  // of the counter, after the supply was cut or POS
  bool has_servo_ = false;
  bool has_reference_;
  bool needs_reference_ = true;  // RON
  bool is_homing_ = false;
  bool has_started_ = false;
  bool is_prefixed_ = false;  // the last command had an address
  int error_ = 0;
  std::string begun_;
};

}  // namespace viscard
