#pragma once

#include "rig/emulator/emulated_rig.h"
#include "rig/open_devices.h"

#include <memory>

namespace viscard {

// The devices of a rig file with their ports open, or those of an emulated rig in its place, with a
// specimen of 10:1 and the truth of the demo. Keeps no record. Throws RigError for a port that
// cannot be opened, and for wrong words of the rig file.
class OpenRig {
 public:
  OpenRig(const RigConfig& rig, bool is_emulated);
  OpenRig(const OpenRig&) = delete;
  OpenRig& operator=(const OpenRig&) = delete;

  const RigConfig& config() const { return config_; }
  const RigClock& clock() const { return clock_; }
  RigDevices& devices() { return devices_; }
  EmulatedRig* emulated() { return emulated_.get(); }  // nullptr: real ports

 private:
  std::unique_ptr<EmulatedRig> emulated_;
  RigConfig config_;
  RigClock clock_;
  RigDevices devices_;
};

}  // namespace viscard
