#pragma once

#include <stdexcept>

namespace viscard {

// One line: what went wrong with an instrument, where, and what to do next.
class RigError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// A port cannot be opened: it does not exist, is used by another program, or may not be read.
class PortUnavailable : public RigError {
 public:
  using RigError::RigError;
};

// The other end of a port is gone: the cable was pulled, or the device or its adapter switched off.
class PortHungUp : public RigError {
 public:
  using RigError::RigError;
};

// A device restarted in the middle of a run: its position, tare and clock are lost.
class DeviceRestarted : public RigError {
 public:
  using RigError::RigError;
};

}  // namespace viscard
