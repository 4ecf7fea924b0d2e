#pragma once

#include "models/experiment/rig_config.h"
#include "models/experiment/run_record.h"

#include <optional>

namespace viscard {

// What the load cell said, in the unit in which its calibration takes it: volts (counts times
// volts_per_count) or, from an instrument that gives a force by itself, newtons. Nothing if the
// sample is no reading, or counts come without volts_per_count.
std::optional<double> reading_from_sample(const LoadSample& sample, const LoadCellConfig& cell);

// Force in N, positive in compression, before any tare:
//   force = +-(reading - zero)/gain
// with zero and gain of the rig's calibration (models/calibration.h). Saturated readings and
// glitches have a force too: the caller decides what they are worth.
std::optional<double> force_N_from_sample(const LoadSample& sample, const RigConfig& rig);

}  // namespace viscard
