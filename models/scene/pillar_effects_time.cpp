#include "models/pillar/analyses/analysis.h"
#include "models/pillar/analyses/pillar_scales.h"
#include "models/scene/pillar_effects.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace viscard {
namespace {

double shortest_ramp_s(const std::vector<HistoryPoint>& points) {
  double shortest = std::numeric_limits<double>::infinity();
  if (!points.empty() && points.front().value != 0.0) shortest = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    if (points[i].value == points[i - 1].value) continue;
    shortest = std::min(shortest, points[i].time_s - points[i - 1].time_s);
  }
  return shortest;
}

}  // namespace

EffectEstimate relaxation_estimate(const PillarScene& scene) {
  if (scene.pillar.terms.empty()) return {.reason = "the material is elastic"};
  const Analysis& analysis = analysis_of(scene);
  EffectEstimate usual{.reason = "answers right after loading, with the instantaneous moduli"};
  if (analysis.relaxes) {
    usual = {EffectRole::kNeeded, 1.0, "", 0.0, "its damping decides the response near resonance"};
  }
  return analysis.relaxation == nullptr ? usual : analysis.relaxation(scene, usual);
}

void leave_out_relaxation(PillarScene& scene) {
  scene.pillar.terms.clear();
}

EffectEstimate inertia_estimate(const PillarScene& scene) {
  if (analysis_of(scene).has_inertia) {
    return {EffectRole::kNeeded, 1.0, "", 0.0, "vibration is nothing else"};
  }
  if (!has_history(scene) || !(scene.pillar.rho_kg_m3 > 0.0)) {
    return {.reason = "the load is at rest"};
  }
  // A rod under a ramp of length t_R rings by sin(x)/x, x = pi f_1 t_R (eq. E7).
  const double x =
      std::numbers::pi * first_rod_frequency_Hz(scene) * shortest_ramp_s(history(scene));
  return {EffectRole::kOutside, x > 1.0 ? 1.0 / x : 1.0, "pi f_1 t_ramp", x,
          "rings out after each ramp; not in a quasi-static answer"};
}

EffectEstimate leakage_estimate(const PillarScene& scene) {
  if (!scene.electrodes) return {.reason = "no electrode"};
  if (scene.readout) {
    return {EffectRole::kNeeded, 1.0, "", 0.0, "the electrode is wired to a readout"};
  }
  return {.reason = "the voltage of an open electrode, before charge leaks"};
}

}  // namespace viscard
