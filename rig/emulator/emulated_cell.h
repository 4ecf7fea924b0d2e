#pragma once

#include "models/experiment/calibration.h"
#include "models/experiment/emulated_specimen.h"
#include "rig/emulator/rig_fault.h"

#include <cstdint>
#include <optional>

namespace viscard {

// The elastic element of a load cell with its amplifier: gain, drift, offset, nonlinearity,
// hysteresis, and noise that depends on the seed and the number of the reading only. Nonlinearity
// and hysteresis are parabolas that vanish at no load and at full scale.
class EmulatedCell {
 public:
  // The gain is truth.cell_gain, or that of the calibration if it is 0.
  EmulatedCell(const EmulatedTruth& truth, const LoadCellCalibration& calibration);

  // The signal of reading number `index` made at time_s, in V (in N for a force gauge).
  double signal(double force_N, double time_s, std::int64_t index);
  // From now on the signal is that of a broken cell or amplifier; kinds of other parts change
  // nothing.
  void set_fault(RigFaultKind kind) { fault_ = kind; }
  // The wire to the converter is open: it reads the end of its range.
  bool is_off_scale() const { return fault_ == RigFaultKind::kOpenWire; }

 private:
  double sound_signal(double force_N, double time_s, std::int64_t index);
  double drifting_signal(double time_s, std::int64_t index);

  EmulatedTruth truth_;
  LoadCellCalibration calibration_;
  double turned_N_ = 0.0;  // the previous force, which shows whether the load rises or falls
  double direction_ = 1.0;
  RigFaultKind fault_ = RigFaultKind::kNone;
  double last_ = 0.0;  // signal
  double filtered_N_ = 0.0, filtered_at_s_ = 0.0;
  std::optional<double> drifts_from_s_;
  double drifts_from_ = 0.0;  // signal
};

}  // namespace viscard
