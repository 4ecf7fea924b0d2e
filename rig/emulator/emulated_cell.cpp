#include "rig/emulator/emulated_cell.h"

#include <algorithm>
#include <cmath>

namespace viscard {
namespace {

// SplitMix64: turns any number into 64 well-mixed bits (Steele, Lea & Flood, OOPSLA 2014).
std::uint64_t mixed(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15ULL;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31);
}

// The normal deviate of mean 0 and variance 1 that belongs to (seed, index), so that the noise of a
// reading does not depend on scheduling. Box-Muller transform of bits from SplitMix64.
double normal_deviate(std::uint64_t seed, std::uint64_t index) {
  const std::uint64_t key = mixed(seed) ^ (2 * index);
  constexpr double kScale = 1.0 / 9007199254740992.0;  // 2^-53
  const double u = (static_cast<double>(mixed(key) >> 11) + 0.5) * kScale;
  const double v = static_cast<double>(mixed(key + 1) >> 11) * kScale;
  return std::sqrt(-2.0 * std::log(u)) * std::cos(6.283185307179586 * v);
}

}  // namespace

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
