#pragma once

#include "models/experiment/emulated_specimen.h"
#include "rig/emulator/emulated_controller.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace viscard {

// Behaviour of real controllers that a driver must cope with. Times on the emulated clock.
struct ZaberHabits {
  bool sends_checksums = true;
  bool sends_alerts = false;   // comm.alert = 1: sends an alert when a move has ended
  bool has_reference = true;   // false: not homed since it was switched on
  bool loses_power = false;    // a restart cuts the supply; otherwise only the port is opened
  bool knows_estop = true;     // older firmware does not
  int lose_reply_every = 0;    // every n-th reply is not sent
  int garble_reply_every = 0;  // every n-th reply has a wrong digit, so its checksum is wrong
  double reply_delay_s = 0.0;
  bool has_neighbour = false;  // device 2 on the chain sends replies in between
};

// A Zaber controller of one axis as a host sees it on the wire (rig/protocols/zaber_protocol.h
// gives the sources). One microstep is one step of the truth.
class EmulatedZaber final : public EmulatedController {
 public:
  EmulatedZaber(const EmulatedTruth& truth, int toward_specimen, int device,
                const ZaberHabits& habits);

  void reset(double time_s) override;
  void receive(std::string_view bytes, double time_s) override;
  void tick(double time_s) override;
  void hit_limit(double time_s) override;

 private:
  void line(std::string_view text, double time_s);
  // The data of an OK reply, or nothing with the reason in rejection_.
  std::optional<std::string> obey(const std::vector<std::string>& words, double time_s);
  std::optional<std::string> get(const std::string& setting, double time_s) const;
  std::optional<std::string> set(const std::string& setting, double value);
  std::optional<std::string> move(const std::vector<std::string>& words, double time_s);
  std::string flag() const;
  void reply(const std::string& id, const std::optional<std::string>& data, double time_s);
  void say(std::string text, double due_s);
  long long microsteps(double time_s) const;
  double speed_m_s() const;
  double acceleration_m_s2() const;

  ZaberHabits habits_;
  double microstep_m_;
  double toward_;
  int device_;
  double max_speed_data_, acceleration_data_;
  bool has_reference_;
  bool has_started_ = false;
  double origin_m_ = 0.0;  // where it counts from
  bool is_stalled_ = false;
  bool is_interrupted_ = false;
  bool was_moving_ = false;
  std::string begun_, rejection_;
  int n_replies_ = 0;
};

}  // namespace viscard
