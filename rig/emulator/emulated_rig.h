#pragma once

#include "models/experiment/emulated_specimen.h"
#include "models/experiment/rig_config.h"
#include "rig/emulator/emulated_amplifier.h"
#include "rig/emulator/emulated_gauge.h"
#include "rig/emulator/emulated_grbl.h"
#include "rig/emulator/emulated_zaber.h"

#include <memory>
#include <string>
#include <vector>

namespace viscard {

struct EmulatedRigOptions {
  EmulatedTruth truth;
  // Of config the drivers, calibration, volts_per_count, axis, direction and clock_speed are used:
  // what the instruments really do.
  RigConfig config;
  GrblHabits grbl;
  ZaberHabits zaber;
  GaugeHabits gauge;
  AmplifierOptions amplifier;
  // What a board does when its port is opened: it resets (UNO, Nano) or not (native USB).
  bool resets_on_open = true;
  double boot_wall_s = 0.1;  // from that reset to the welcome
  bool keeps_lines = false;  // remembers what the amplifier said: sent_lines()
};

// What happened on the bench that no wire tells.
struct EmulatedOutcome {
  double peak_force_N = 0.0;
  double peak_depth_m = 0.0;
  bool is_cell_broken = false;  // the force went above truth.overload_N
  double final_position_m = 0.0;
  bool is_moving = false;
};

// A stage (GRBL or Zaber) and a load cell (HX711 amplifier, multimeter or force gauge) as config's
// drivers say, on two pseudo-terminals, pressing an emulated specimen, on a
// clock that runs config.clock_speed times as fast as the wall's. One thread does it all; the
// destructor ends it and hangs up both ports.
class EmulatedRig {
 public:
  // Throws std::runtime_error if there is no pseudo-terminal, std::invalid_argument on a bad truth.
  explicit EmulatedRig(const EmulatedRigOptions& options);
  ~EmulatedRig();

  std::string stage_port() const;
  std::string load_cell_port() const;
  // config with both ports filled in.
  RigConfig config() const;

  EmulatedOutcome outcome() const;
  // Every line of the amplifier since it was first opened, terminators and all.
  std::vector<std::string> sent_lines() const;

  // A weight on the load cell besides what the stage presses; replaces the one before.
  void hang_weight(double force_N);

  // Incidents, to be set off from any thread.
  void pull_stage_cable();
  void pull_load_cell_cable();
  void silence_load_cell();  // the stream stalls, the port stays
  void restart_load_cell();  // a brown-out: banner, clock from 0
  void restart_stage();
  void hit_limit_switch();
  void stall(double wall_s);  // the thread does nothing for so long

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace viscard
