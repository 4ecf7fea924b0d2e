#pragma once

#include "models/experiment/emulated_specimen.h"
#include "models/experiment/rig_config.h"
#include "rig/emulator/emulated_amplifier.h"
#include "rig/emulator/emulated_gauge.h"
#include "rig/emulator/emulated_grbl.h"
#include "rig/emulator/emulated_zaber.h"

namespace viscard {

struct EmulatedRigOptions {
  EmulatedTruth truth;
  // The true properties of the instruments; drivers, calibration, volts_per_count, axis, direction
  // and clock_speed are used.
  RigConfig config;
  GrblHabits grbl;
  ZaberHabits zaber;
  GaugeHabits gauge;
  AmplifierOptions amplifier;
  // Boards with a USB converter (UNO, Nano) reset when their port is opened, native USB does not.
  bool resets_on_open = true;
  double boot_wall_s = 0.1;  // from that reset to the welcome
  bool keeps_lines = false;  // keeps the lines of the amplifier for sent_lines()
};

}  // namespace viscard
