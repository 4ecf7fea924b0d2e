#pragma once

#include "tests/rig/stages/stage_rig.h"

#include <string>

namespace viscard {

// For tests of drivers that derive from AskedStage.

inline AnswerHabits& answers_of(EmulatedRigOptions& options) {
  return options.config.stage.driver == "smc100" ? options.smc.answers : options.pi.answers;
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
