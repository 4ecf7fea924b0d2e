#pragma once

#include "models/experiment/emulated_specimen.h"

#include <cstdint>

namespace viscard {

// What the elastic element of a load cell makes of a force: drift, offset, a bow (nonlinearity), a
// loop between rising and falling load (hysteresis), and noise that depends on the seed and the
// number of the reading alone. Bow and loop are parabolas that vanish at no load and at full scale.
class EmulatedCell {
 public:
  explicit EmulatedCell(const EmulatedTruth& truth) : truth_(truth) {}

  // Signal as a force, N, for reading number `index` made at time_s.
  double signal_N(double force_N, double time_s, std::uint64_t index);

 private:
  EmulatedTruth truth_;
  double turned_N_ = 0.0;  // force at which the direction was last sure
  double direction_ = 1.0;
};

}  // namespace viscard
