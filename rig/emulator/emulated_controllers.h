#pragma once

#include "rig/emulator/emulated_controller.h"
#include "rig/emulator/emulated_rig_options.h"

#include <memory>

namespace viscard {

// The emulated stage controller for config.stage.driver; GRBL for an unknown word, which the driver
// then refuses. A new controller is a row of the table in emulated_controllers.cpp.
std::unique_ptr<EmulatedController> emulated_controller(const EmulatedRigOptions& options);

}  // namespace viscard
