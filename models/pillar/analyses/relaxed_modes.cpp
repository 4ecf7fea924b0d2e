#include "models/pillar/analyses/relaxed_modes.h"

#include "models/pillar/analyses/buckling_limit.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace viscard {
namespace {

double relaxed_frequency_Hz(double f0_Hz, const PronySeries& series, double stress_share) {
  const double E0 = instantaneous_modulus_Pa(series);
  double f_Hz = f0_Hz;
  constexpr int kIterations = 40;  // each wins a factor of d ln E'/d ln f < 1/2 at least
  for (int i = 0; i < kIterations; ++i) {
    const double E = complex_modulus_Pa(series, 2.0 * std::numbers::pi * f_Hz).storage_Pa / E0;
    f_Hz = f0_Hz * std::sqrt(std::max(0.0, (E - stress_share) / (1.0 - stress_share)));
  }
  return f_Hz;
}

}  // namespace

void relax_modes(const PillarScene& scene, SceneAnswer& answer) {
  if (scene.pillar.terms.empty()) return;
  const PronySeries young = young_series(scene.pillar);
  const PronySeries shear = shear_series(scene.pillar);
  const double share = pressure_Pa(scene) / engesser_pressure_Pa(scene);
  double first_lateral_Hz = 0.0;
  for (SceneMode& mode : answer.modes) {
    double stress_share = 0.0;
    if (mode.family == "lateral") {
      if (first_lateral_Hz == 0.0) first_lateral_Hz = mode.frequency_Hz;
      const double stiffer = first_lateral_Hz / mode.frequency_Hz;
      stress_share = std::min(0.99, share * stiffer * stiffer);
    }
    const double f_Hz = relaxed_frequency_Hz(
        mode.frequency_Hz, mode.family == "torsion" ? shear : young, stress_share);
    const bool exact = !scene.film && stress_share == 0.0 &&
                       (has_constant_poisson_ratio(scene.pillar) || mode.family == "torsion");
    if (!exact) mode.error_estimate += 0.1 * std::abs(mode.frequency_Hz - f_Hz);
    mode.frequency_Hz = f_Hz;
  }
}

}  // namespace viscard
