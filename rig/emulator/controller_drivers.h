#pragma once

#include "models/experiment/emulated_specimen.h"
#include "models/experiment/rig_config.h"
#include "rig/emulator/emulated_controller.h"
#include "rig/emulator/emulated_grbl.h"
#include "rig/emulator/emulated_zaber.h"

#include <memory>

namespace viscard {

// The emulated controller for config.driver; a GRBL for an unknown word, which the driver refuses.
std::unique_ptr<EmulatedController> emulated_controller(const StageConfig& config,
                                                        const EmulatedTruth& truth,
                                                        const GrblHabits& grbl,
                                                        const ZaberHabits& zaber);

}  // namespace viscard
