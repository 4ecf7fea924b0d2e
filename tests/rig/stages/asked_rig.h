#pragma once

#include "tests/rig/device_fixture.h"

#include <string>

namespace viscard {

// For tests of drivers that derive from AskedStage.

inline AnswerHabits& answers_of(EmulatedRigOptions& options) {
  return options.config.stage.driver == "smc100" ? options.smc.answers : options.pi.answers;
}

// Pumps until the stage has moved for move_s.
inline void pump_into_move(DeviceFixture& rig, double move_s) {
  const double until_s = rig.clock.awake_s() + 10.0;
  while (!rig.emulated.outcome().is_moving && rig.clock.awake_s() < until_s) rig.pump()();
  rig.pump_for(move_s);
}

// How often a move was written to the stage.
inline int n_moves_written(const DeviceFixture& rig) {
  int n = 0;
  for (const RawBytes& raw : rig.all<RawBytes>()) {
    if (raw.device != Device::kStage || !raw.is_sent) continue;
    const bool is_pi = raw.bytes.find("MOV ") != std::string::npos;
    const bool is_smc =
        raw.bytes.find("PA") != std::string::npos && raw.bytes.find('?') == std::string::npos;
    n += is_pi || is_smc ? 1 : 0;
  }
  return n;
}

}  // namespace viscard
