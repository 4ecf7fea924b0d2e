#include "models/pillar/analyses/pillar_scales.h"

#include <algorithm>
#include <cmath>

namespace viscard {

PronySeries largest_relaxation(const Material& material) {
  PronySeries series;
  double rest = 1.0;
  for (const MaterialTerm& term : material.terms) {
    const double share = std::max(term.g, term.k);
    series.terms.push_back({share, term.tau_s});
    rest -= share;
  }
  series.equilibrium_modulus_Pa = std::max(rest, 1e-3);
  return series;
}

double first_rod_frequency_Hz(const PillarScene& scene) {
  return std::sqrt(scene.pillar.E0_Pa / scene.pillar.rho_kg_m3) / (4.0 * scene.geometry.length_m);
}

}  // namespace viscard
