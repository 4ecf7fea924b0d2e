#pragma once

#include "models/experiment/emulated_specimen.h"
#include "models/experiment/rig_config.h"
#include "rig/emulator/emulated_amplifier.h"
#include "rig/emulator/emulated_apt.h"
#include "rig/emulator/emulated_gauge.h"
#include "rig/emulator/emulated_grbl.h"
#include "rig/emulator/emulated_marlin.h"
#include "rig/emulator/emulated_pi.h"
#include "rig/emulator/emulated_smc.h"
#include "rig/emulator/emulated_thermometer.h"
#include "rig/emulator/emulated_zaber.h"
#include "rig/emulator/rig_fault.h"

namespace viscard {

// The parts of an emulated rig, and how its devices behave.
struct EmulatedRigOptions {
  EmulatedTruth truth;
  // The true properties of the instruments; drivers, calibration, volts_per_count, axis, direction
  // and clock_speed are used.
  RigConfig config;
  // By default the rig waits for the program that uses it: its time passes only while that program
  // waits for bytes, and clock_speed limits how much faster than the wall clock it may be. The
  // answer then depends neither on the speed nor on other load of the computer. On the wall clock a
  // busy computer is late, as it would be for a real rig.
  bool is_on_wall_clock = false;
  GrblHabits grbl;
  ZaberHabits zaber;
  AptHabits apt;
  MarlinHabits marlin;
  PiHabits pi;
  SmcHabits smc;
  GaugeHabits gauge;
  AmplifierOptions amplifier;
  ThermometerHabits thermometer;  // of the one that config names
  RigFault fault;
  double travel_scale = 1.0;   // true travel of the stage over the one it counts
  double lost_before_m = 0.0;  // of an earlier run: what the stage has counted and not travelled
  // Boards with a USB converter (UNO, Nano) reset when their port is opened, native USB does not.
  bool resets_on_open = true;
  double boot_wall_s = 0.1;  // from that reset to the welcome; rig time for a rig that waits
  bool keeps_lines = false;  // keeps what the load cell's instrument sends, for sent_lines()
};

// A rig that can do what its rig file asks for: with home = true its stage homes one axis alone.
inline EmulatedRigOptions able_rig(const EmulatedTruth& truth, const RigConfig& config) {
  EmulatedRigOptions options;
  options.truth = truth;
  options.config = config;
  options.grbl.is_homing_enabled = options.grbl.has_hard_limits = config.stage.home;
  return options;
}

}  // namespace viscard
