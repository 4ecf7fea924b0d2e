#include "rig/emulator/emulated_cell.h"

#include "rig/emulator/seeded_noise.h"

#include <algorithm>
#include <cmath>

namespace viscard {

EmulatedCell::EmulatedCell(const EmulatedTruth& truth, const LoadCellCalibration& calibration)
    : truth_(truth), calibration_(calibration) {
  if (truth.cell_gain > 0.0) calibration_.volts_per_newton = truth.cell_gain;
}

double EmulatedCell::sound_signal(double force_N, double time_s, std::int64_t index) {
  if (fault_ == RigFaultKind::kNoExcitation) force_N = 0.0;
  if (fault_ == RigFaultKind::kHalfGain) force_N *= 0.5;
  constexpr double kFilter_s = 0.15;
  const double passed = -std::expm1(-std::max(0.0, time_s - filtered_at_s_) / kFilter_s);
  filtered_N_ += passed * (force_N - filtered_N_);
  filtered_at_s_ = time_s;
  if (fault_ == RigFaultKind::kFiltered) force_N = filtered_N_;
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

// An input that floats: a drift of 1 to 6 % of full scale per second and noise of 0.3 to 2 %, both
// drawn by the seed.
double EmulatedCell::drifting_signal(double time_s, std::int64_t index) {
  if (!drifts_from_s_) {
    drifts_from_s_ = time_s;
    drifts_from_ = last_;
  }
  const double side = normal_deviate(truth_.seed, 1u << 30) > 0.0 ? 1.0 : -1.0;
  const double drawn = std::min(1.0, std::abs(normal_deviate(truth_.seed, (1u << 30) + 1)) / 3.0);
  const double drift = side * (0.01 + 0.05 * drawn) * (time_s - *drifts_from_s_);
  const double noise =
      (0.003 + 0.017 * drawn) * normal_deviate(truth_.seed + 1, static_cast<std::uint64_t>(index));
  return drifts_from_ + (drift + noise) * truth_.cell_full_scale_N * calibration_.volts_per_newton;
}

double EmulatedCell::signal(double force_N, double time_s, std::int64_t index) {
  constexpr double kClipsAt = 0.25;  // of full scale
  const double sound = sound_signal(force_N, time_s, index);
  switch (fault_) {
    case RigFaultKind::kFrozen:
      if (index == 0) last_ = sound;
      break;
    case RigFaultKind::kZeros:
      last_ = 0.0;
      break;
    case RigFaultKind::kDriftingWire:
      return drifting_signal(time_s, index);
    case RigFaultKind::kSaturation:
      last_ =
          std::min(sound, volts_from_force_N(calibration_, kClipsAt * truth_.cell_full_scale_N));
      break;
    default:
      last_ = sound;
  }
  return last_;
}

}  // namespace viscard
