#pragma once

#include "models/experiment/rig_config.h"
#include "rig/move_stage.h"

#include <atomic>

namespace viscard {

// Opens the devices of the rig, or of an emulated one, and carries out the order. stop: set by a
// signal handler; may be nullptr. Throws RigError as move_stage() does, and if another program holds
// a port.
StageMoved move_rig_stage(RigConfig rig, bool is_emulated, const StageOrder& order,
                          const std::atomic<bool>* stop);

}  // namespace viscard
