#pragma once

#include "rig/lines/rig_error.h"

namespace viscard {

// A person asked the run to end.
class RunInterrupted : public RigError {
 public:
  using RigError::RigError;
};

// The force reached a limit; the stage has been sent a stop.
class LimitReached : public RigError {
 public:
  using RigError::RigError;
};

}  // namespace viscard
