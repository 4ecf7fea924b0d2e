#pragma once

#include "models/experiment/rig_config.h"
#include "rig/cells/load_cell.h"
#include "rig/lines/rig_clock.h"

#include <atomic>
#include <functional>

namespace viscard {

struct TouchOptions {
  double wait_s = 30.0;                     // for the finger or weight, and again for its end
  std::function<void()> ready;              // the zero is known: touch the cell now
  std::function<void()> felt;               // the force has changed: take it away again
  const std::atomic<bool>* stop = nullptr;  // ends the wait
};

// Waits until somebody puts a finger or a weight on the load cell and takes it away again, which
// moves nothing else. Returns the largest change of the force, N. Throws RigError if the rig at
// rest shows what forbids a test (findings_at_rest()), and unless the force changes by more than
// its noise and 1 % of the capacity for three readings in a row and then comes back: what drifts or
// jumps does not.
double await_touch(LoadCell& load_cell, const RigConfig& rig, const RigClock& clock,
                   const TouchOptions& options);

}  // namespace viscard
