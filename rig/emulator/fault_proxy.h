#pragma once

#include "rig/emulator/line_faults.h"

#include <cstdint>
#include <memory>
#include <string>

namespace viscard {

struct FaultPlan {
  std::uint64_t seed = 1;
  FaultRates to_host, to_device;
  double longest_delay_s = 0.15;  // wall
};

// Connects a host to an emulated device and disturbs the line in both directions. Bytes never
// overtake one another, as on a real line. The device's port is opened and closed when the host
// opens and closes path(), so that boards reset as they would without the proxy.
class FaultProxy {
 public:
  FaultProxy(const std::string& device_path, const FaultPlan& plan);
  ~FaultProxy();

  std::string path() const;
  FaultCounts counts() const;
  // From now on there are no more faults.
  void heal();
  void hang_up();

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace viscard
