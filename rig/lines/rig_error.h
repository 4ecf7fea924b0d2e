#pragma once

#include <stdexcept>

namespace viscard {

// What went wrong with an instrument, where, and what to do next, in one line.
class RigError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// The other end of a port is gone: cable pulled, device switched off, adapter vanished.
class PortHungUp : public RigError {
 public:
  using RigError::RigError;
};

// A device started anew in the middle of a run: its position, tare and clock are gone.
class DeviceRestarted : public RigError {
 public:
  using RigError::RigError;
};

}  // namespace viscard
