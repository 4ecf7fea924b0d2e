#include "models/pillar/analyses/air_damping.h"

#include "models/pillar/analyses/analysis.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace viscard {
namespace {

// exp(z) K_order(z) = int_0^inf exp(-z (cosh t - 1)) cosh(order t) dt, by the trapezoidal rule, which converges
// exponentially: Abramowitz & Stegun (1964), 9.6.24. Ratios of two orders need no exp(z).
std::complex<double> scaled_bessel_k(int order, std::complex<double> z) {
  constexpr double kStep = 1.0 / 64.0;
  std::complex<double> sum = 0.5;
  for (int i = 1;; ++i) {
    const double t = kStep * i;
    const double rise = 2.0 * std::pow(std::sinh(0.5 * t), 2);  // cosh t - 1
    if (z.real() * rise > 45.0 + order * t) break;
    sum += std::exp(-z * rise) * std::cosh(order * t);
  }
  return kStep * sum;
}

AirMotion motion_of(const std::string& family) {
  if (family == "longitudinal") return AirMotion::kAlong;
  if (family == "ovalling") return AirMotion::kOvalling;
  return family == "torsion" ? AirMotion::kTurning : AirMotion::kSideways;
}

}  // namespace

std::complex<double> air_factor(AirMotion motion, std::complex<double> z) {
  if (motion == AirMotion::kTurning) {
    return 4.0 * scaled_bessel_k(2, z) / (z * scaled_bessel_k(1, z));
  }
  const std::complex<double> ratio = scaled_bessel_k(1, z) / (z * scaled_bessel_k(0, z));
  if (motion == AirMotion::kAlong) return 2.0 * ratio;
  return (motion == AirMotion::kOvalling ? 0.5 : 1.0) * (1.0 + 4.0 * ratio);
}

AirLoad air_load(const PillarScene& scene, AirMotion motion, double frequency_Hz) {
  const Surroundings& around = scene.surroundings;
  const double omega_1_s = 2.0 * std::numbers::pi * frequency_Hz;
  const double decay_1_m2 = omega_1_s * around.air_density_kg_m3 / around.air_viscosity_Pa_s;
  const std::complex<double> z =
      0.5 * scene.geometry.diameter_m * std::sqrt(std::complex<double>(0.0, decay_1_m2));
  const std::complex<double> added =
      around.air_density_kg_m3 / scene.pillar.rho_kg_m3 * air_factor(motion, z);
  const double whole = 1.0 + added.real();
  return {-0.5 * added.imag() / whole, 1.0 - 1.0 / std::sqrt(whole)};
}

AirLoad air_load_of_slowest_mode(const PillarScene& scene) {
  const double R_over_L = 0.5 * scene.geometry.diameter_m / scene.geometry.length_m;
  // f = 1.8751^2/(2 pi) sqrt(E I/(rho A))/L^2, in units of that of the rod, sqrt(E/rho)/(4 L).
  const double beam = 1.8751 * 1.8751 / std::numbers::pi * R_over_L;
  return air_load(scene, AirMotion::kSideways, std::min(1.0, beam) * first_rod_frequency_Hz(scene));
}

void add_air(const PillarScene& scene, SceneAnswer& answer) {
  if (!scene.surroundings.air) return;
  for (SceneMode& mode : answer.modes) {
    const AirLoad air = air_load(scene, motion_of(mode.family), mode.frequency_Hz);
    mode.frequency_Hz *= 1.0 - air.frequency_share;
    mode.damping_ratio = mode.damping_ratio.value_or(0.0) + air.damping_ratio;
  }
}

void add_air_errors(const PillarScene& scene, SceneAnswer& answer) {
  if (!scene.surroundings.air) return;
  for (SceneMode& mode : answer.modes) {
    const AirLoad air = air_load(scene, motion_of(mode.family), mode.frequency_Hz);
    const double unknown = motion_of(mode.family) == AirMotion::kOvalling
                               ? 1.0
                               : 0.5 * scene.geometry.diameter_m / scene.geometry.length_m;
    mode.error_estimate += unknown * air.frequency_share * mode.frequency_Hz;
    mode.damping_error += unknown * air.damping_ratio;
  }
}

}  // namespace viscard
