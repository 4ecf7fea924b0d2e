#pragma once

#include "rig/emulator/emulated_controller.h"
#include "rig/emulator/emulated_rig_options.h"

#include <memory>

namespace viscard {

// The parts of an emulated rig that its rig file selects.

std::unique_ptr<EmulatedController> emulated_controller(const EmulatedRigOptions& options);

// Those of the options, with frames if the driver is "adc-frames".
AmplifierOptions amplifier_options(const EmulatedRigOptions& options);

}  // namespace viscard
