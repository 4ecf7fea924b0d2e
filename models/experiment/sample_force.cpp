#include "models/experiment/sample_force.h"

namespace viscard {

std::optional<double> reading_from_sample(const LoadSample& sample, const LoadCellConfig& cell) {
  if (sample.force_N) return sample.force_N;
  if (sample.volts) return sample.volts;
  if (!sample.counts || cell.volts_per_count == 0.0) return std::nullopt;
  return *sample.counts * cell.volts_per_count;
}

std::optional<double> force_N_from_sample(const LoadSample& sample, const RigConfig& rig) {
  const std::optional<double> reading = reading_from_sample(sample, rig.load_cell);
  if (!reading) return std::nullopt;
  const double force_N = force_N_from_volts(rig.calibration, *reading);
  return rig.load_cell.compression_is_positive ? force_N : -force_N;
}

}  // namespace viscard
