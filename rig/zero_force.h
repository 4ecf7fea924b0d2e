#pragma once

#include "models/experiment/rig_config.h"
#include "rig/cells/load_cell.h"
#include "rig/lines/rig_clock.h"

#include <atomic>

namespace viscard {

// Forces by the calibration, without a tare.
struct ZeroedForce {
  double before_N = 0.0;
  double after_N = 0.0;
};

// Lets the instrument make the force at rest its own zero. Nothing of that is kept here: a test
// measures the force out of contact itself. Throws RigError if the instrument has no zero of its
// own, if more than a tenth of the capacity acts, because a zero would then hide an overload, and if
// stop is set.
ZeroedForce zero_force(LoadCell& load_cell, const RigConfig& rig, const RigClock& clock,
                       const std::atomic<bool>* stop);

}  // namespace viscard
