#pragma once

#include <cstdint>
#include <memory>
#include <string>

namespace viscard {

// Chances, per piece of the stream that is passed on, that something happens to it.
struct FaultRates {
  double drop = 0.0;       // a few of its bytes are lost
  double duplicate = 0.0;  // it comes twice
  double split = 0.0;      // its second half comes some milliseconds later
  double delay = 0.0;      // it and all behind it come later
  double garble = 0.0;     // one byte changes: any bit, or one digit into another
  double insert = 0.0;     // a few bytes of noise come before it
  double hang_up = 0.0;    // the line goes away for good
};

struct FaultPlan {
  std::uint64_t seed = 1;
  FaultRates to_host, to_device;
  double longest_delay_s = 0.15;  // wall
};

struct FaultCounts {
  int pieces = 0;     // passed on or not
  int faults = 0;     // that happened, all kinds
  int corrupted = 0;  // of these: garbled, inserted or dropped, which change what a line says
  bool has_hung_up = false;
};

// Stands between a host and an emulated device, a pseudo-terminal toward each, and disturbs the
// line in both directions. Bytes never overtake one another, as on a real line. The device's port
// is opened when the host opens path(), and closed with it, so that boards reset as they would.
class FaultProxy {
 public:
  FaultProxy(const std::string& device_path, const FaultPlan& plan);
  ~FaultProxy();

  std::string path() const;
  FaultCounts counts() const;
  // From now on the line is clean.
  void heal();
  void hang_up();

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace viscard
