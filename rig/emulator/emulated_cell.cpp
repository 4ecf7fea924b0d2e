#include "rig/emulator/emulated_cell.h"

#include "rig/emulator/seeded_noise.h"

#include <algorithm>

namespace viscard {

EmulatedCell::EmulatedCell(const EmulatedTruth& truth, const LoadCellCalibration& calibration)
    : truth_(truth), calibration_(calibration) {
  if (truth.cell_gain > 0.0) calibration_.volts_per_newton = truth.cell_gain;
}

double EmulatedCell::signal(double force_N, double time_s, std::int64_t index) {
  const double step_N = force_N - turned_N_;
  if (step_N != 0.0) direction_ = step_N > 0.0 ? 1.0 : -1.0;
  turned_N_ = force_N;
  const double share = std::clamp(force_N / truth_.cell_full_scale_N, 0.0, 1.0);
  const double parabola_N = 4.0 * share * (1.0 - share) * truth_.cell_full_scale_N;
  const double measured_N =
      force_N * (1.0 + truth_.drift_relative_per_s * time_s) + truth_.force_offset_N +
      parabola_N * (truth_.cell_nonlinearity - 0.5 * direction_ * truth_.cell_hysteresis) +
      truth_.force_noise_N * normal_deviate(truth_.seed, static_cast<std::uint64_t>(index));
  return volts_from_force_N(calibration_, measured_N);
}

}  // namespace viscard
