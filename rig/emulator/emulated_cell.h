#pragma once

#include "models/experiment/emulated_specimen.h"

#include <cstdint>

namespace viscard {

// The elastic element of a load cell: drift, offset, nonlinearity, hysteresis, and noise that
// depends on the seed and the number of the reading only. Nonlinearity and hysteresis are parabolas
// that vanish at no load and at full scale.
class EmulatedCell {
 public:
  explicit EmulatedCell(const EmulatedTruth& truth) : truth_(truth) {}

  // The signal, expressed as a force in N, of reading number `index` made at time_s.
  double signal_N(double force_N, double time_s, std::uint64_t index);

 private:
  EmulatedTruth truth_;
  double turned_N_ = 0.0;  // the previous force, which shows whether the load rises or falls
  double direction_ = 1.0;
};

}  // namespace viscard
