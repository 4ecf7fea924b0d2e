#pragma once

#include "models/experiment/rig_config.h"
#include "models/experiment/run_record.h"

#include <optional>

namespace viscard {

// The reading in the calibration's unit: volts (counts times volts_per_count) or newtons from an
// instrument that sends forces. Nothing without a number, or for counts without volts_per_count.
std::optional<double> reading_from_sample(const LoadSample& sample, const LoadCellConfig& cell);

// Force in N, positive in compression, before any tare:
//   force = +-(reading - zero)/gain
// with zero and gain of the rig's calibration (calibration.h). Saturated readings and glitches have
// a force too; the caller decides whether to use it.
std::optional<double> force_N_from_sample(const LoadSample& sample, const RigConfig& rig);

}  // namespace viscard
