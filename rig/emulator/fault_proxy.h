#pragma once

#include "rig/emulator/emulated_rig.h"

#include <cstdint>
#include <memory>
#include <string>

namespace viscard {

// Probabilities of faults, for each piece of the stream that is passed on.
struct FaultRates {
  double drop = 0.0;       // a few of its bytes are lost
  double duplicate = 0.0;  // it is passed on twice
  double split = 0.0;      // its second half arrives some milliseconds later
  double delay = 0.0;      // it and everything after it arrive later
  double garble = 0.0;     // one digit becomes another, or one bit of another byte flips
  double insert = 0.0;     // a few bytes of noise are inserted
  double hang_up = 0.0;    // the line hangs up for good
};

struct FaultCounts {
  int pieces = 0;     // of the stream, passed on or not
  int faults = 0;     // of all kinds
  int corrupted = 0;  // faults that change a line: garbled, inserted or dropped bytes
  bool has_hung_up = false;
};

struct FaultPlan {
  std::uint64_t seed = 1;
  FaultRates to_host, to_device;
  double longest_delay_s = 0.15;  // wall; rig time for a rig that waits, also below
  double to_host_B_s = 0.0;       // bytes that the line carries in a second of wall time; 0: all
};

// Connects a host to an emulated device and disturbs the line in both directions. Bytes never
// overtake one another, as on a real line. The device's port is opened and closed when the host
// opens and closes path(), so that boards reset as they would without the proxy. The line of a rig
// that waits waits too: the faults of a plan always come at the same times.
class FaultProxy {
 public:
  // device_path: one of the two ports of the rig.
  FaultProxy(EmulatedRig& rig, const std::string& device_path, const FaultPlan& plan);
  ~FaultProxy();

  std::string path() const;
  FaultCounts counts() const;
  // From now on there are no more faults.
  void heal();
  void hang_up();
  // From now on the line to the host carries only so many bytes in a second of wall time.
  void slow_to(double bytes_per_s);

 private:
  class Lane;
  class Impl;
  std::shared_ptr<Impl> impl_;  // also held by a rig that waits
};

}  // namespace viscard
