#include "models/material/hereditary.h"
#include "models/material/retardation_spectrum.h"
#include "models/pillar/analyses/analysis.h"
#include "models/pillar/plan/effects.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace viscard {
namespace {

bool is_in_time(const Scene& scene) {
  return scene.kind == AnalysisKind::kCreep || scene.kind == AnalysisKind::kRelaxation;
}

// A solid that relaxes in every deformation at least as much as this one does in any: per term the
// larger of shear and bulk, on E_0.
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

// Sum of |changes| of the history over its largest value.
double total_variation(const Scene& scene) {
  double last = 0.0, sum = 0.0, peak = 0.0;
  for (const HistoryPoint& point : scene.history) {
    sum += std::abs(point.value - last);
    last = point.value;
    peak = std::max(peak, std::abs(last));
  }
  return peak > 0.0 ? sum / peak : 1.0;
}

// Largest relative deviation from the elastic answer over the history (eq. E3).
double relaxed_share(const Scene& scene, const PronySeries& series) {
  const double E0 = instantaneous_modulus_Pa(series);
  const double end_s = scene.history.back().time_s;
  const double share =
      scene.kind == AnalysisKind::kCreep
          ? creep_compliance_1_Pa(retardation_from_relaxation(series), end_s) * E0 - 1.0
          : 1.0 - relaxation_modulus_Pa(series, end_s) / E0;
  return share * total_variation(scene);
}

double first_rod_frequency_Hz(const Scene& scene) {
  return std::sqrt(scene.pillar.E0_Pa / scene.pillar.rho_kg_m3) / (4.0 * scene.geometry.length_m);
}

double shortest_ramp_s(const Scene& scene) {
  double shortest = std::numeric_limits<double>::infinity();
  if (!scene.history.empty() && scene.history.front().value != 0.0) shortest = 0.0;
  for (std::size_t i = 1; i < scene.history.size(); ++i) {
    if (scene.history[i].value == scene.history[i - 1].value) continue;
    shortest = std::min(shortest, scene.history[i].time_s - scene.history[i - 1].time_s);
  }
  return shortest;
}

}  // namespace

EffectEstimate relaxation_estimate(const Scene& scene) {
  if (scene.pillar.terms.empty()) return {.reason = "the material is elastic"};
  if (is_in_time(scene)) {
    const double share = relaxed_share(scene, largest_relaxation(scene.pillar));
    return {EffectRole::kOptional, share, "relaxed share at the end", share,
            "the modulus that is lost over the history"};
  }
  if (scene.kind == AnalysisKind::kModal && scene.pillar.rho_kg_m3 > 0.0) {
    const PronySeries series = largest_relaxation(scene.pillar);
    const double nu_w = 2.0 * std::numbers::pi * 0.5 *
                        std::min(1.0, 0.5 * scene.geometry.diameter_m / scene.geometry.length_m) *
                        first_rod_frequency_Hz(scene);
    const double loss =
        1.0 - complex_modulus_Pa(series, nu_w).storage_Pa / instantaneous_modulus_Pa(series);
    return {EffectRole::kOptional, 0.5 * loss, "1 - E'(w)/E_0", loss,
            "the modulus at the lowest frequency"};
  }
  if (analysis_of(scene.kind).relaxes) {
    return {EffectRole::kNeeded, 1.0, "", 0.0, "its damping decides the response near resonance"};
  }
  return {.reason = "answers right after loading, with the instantaneous moduli"};
}

void leave_out_relaxation(Scene& scene) {
  scene.pillar.terms.clear();
}

EffectEstimate inertia_estimate(const Scene& scene) {
  if (analysis_of(scene.kind).has_inertia) {
    return {EffectRole::kNeeded, 1.0, "", 0.0, "vibration is nothing else"};
  }
  if (!is_in_time(scene) || !(scene.pillar.rho_kg_m3 > 0.0)) {
    return {.reason = "the load is at rest"};
  }
  // A rod under a ramp of length t_R rings by sin(x)/x, x = pi f_1 t_R (eq. E7).
  const double x = std::numbers::pi * first_rod_frequency_Hz(scene) * shortest_ramp_s(scene);
  return {EffectRole::kOutside, x > 1.0 ? 1.0 / x : 1.0, "pi f_1 t_ramp", x,
          "rings out after each ramp; not in a quasi-static answer"};
}

EffectEstimate leakage_estimate(const Scene& scene) {
  if (!scene.electrodes) return {.reason = "no electrode"};
  if (scene.readout) {
    return {EffectRole::kNeeded, 1.0, "", 0.0, "the electrode is wired to a readout"};
  }
  return {.reason = "the voltage of an open electrode, before charge leaks"};
}

}  // namespace viscard
