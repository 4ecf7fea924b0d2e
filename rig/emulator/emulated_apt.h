#pragma once

#include "models/experiment/emulated_specimen.h"
#include "rig/emulator/emulated_controller.h"
#include "rig/protocols/apt_protocol.h"

#include <optional>
#include <string>
#include <string_view>

namespace viscard {

// Behaviour of real controllers that a driver must cope with. Times on the emulated clock; numbers
// count from 1, and 0 means never.
struct AptHabits {
  std::string model = "KDC101";           // a KST101 or LTS150 sends the status of steppers
  bool sends_events = true;               // when a move has ended; some units never do
  bool events_carry_status = false;       // with 14 bytes of data
  bool sends_event_before_reply = false;  // before the answer to each question
  bool is_homed = true;                   // false: not homed since it was switched on
  bool stays_disabled = false;            // its motor is switched off at the controller
  bool has_no_speed = false;  // speed, acceleration and homing speed are 0 after power-up
  bool loses_power = false;   // a restart cuts the supply; otherwise only the port is opened
  int lose_reply_every = 0;
  int pause_reply_every = 0;  // every n-th reply is sent in two halves, pause_s apart
  double pause_s = 0.2;
  double reply_delay_s = 0.0;
  double start_delay_s = 0.0;  // from a command to its motion, and to the bit that shows it
  int lose_move_number = 0;    // this command never arrives
  int lose_speed_number = 0;
  int lose_stop_number = 0;
  int misread_move_number = 0;  // this move goes 1 mm further than asked for
  int ends_short_number = 0;    // this move stops half way
};

// A Thorlabs motor controller of one channel as a host sees it on the wire
// (rig/protocols/apt_protocol.h gives the sources). One count is one step of the truth.
class EmulatedApt final : public EmulatedController {
 public:
  EmulatedApt(const EmulatedTruth& truth, int toward_specimen, const AptHabits& habits);

  void reset(double time_s) override;
  void receive(std::string_view bytes, double time_s) override;
  void tick(double time_s) override;
  void hit_limit(double time_s) override;

 private:
  struct Due {
    double time_s, to_m;
  };
  void obey(std::uint16_t id, std::uint8_t p2, std::string_view data, double time_s);
  void move(std::int32_t counts, double time_s);
  void stop(bool is_gentle, double time_s);
  void reply(const std::string& bytes, double time_s);
  void send_event(std::uint16_t id, double time_s);
  std::string info() const;
  std::string status(double time_s) const;
  std::uint32_t bits(double time_s) const;
  std::int32_t counts(double time_s) const;
  double speed_m_s() const;
  double acceleration_m_s2() const;

  AptHabits habits_;
  AptUnits units_;
  double count_m_;
  double toward_;
  double origin_m_ = 0.0;  // bench position of count 0
  AptVelocity velocity_;
  std::string home_parameters_;
  bool is_homed_, is_enabled_ = false, is_homing_ = false;
  bool was_moving_ = false, has_run_ = false, is_stopped_ = false;
  std::optional<double> limit_at_m_;  // a limit switch is closed there
  std::optional<Due> due_;            // a move that has not begun
  std::string begun_;
  double heard_s_ = 0.0;
  int n_replies_ = 0, n_moves_ = 0, n_speeds_ = 0, n_stops_ = 0;
};

}  // namespace viscard
