#include "models/material/hereditary.h"
#include "models/pillar/analyses/analysis.h"
#include "models/pillar/analyses/pillar_results.h"
#include "models/pillar/analyses/quasi_static_history.h"

namespace viscard {
namespace {

std::vector<std::string> relaxation_names(const PillarScene& scene) {
  return moving_names(scene, "top_pressure", {"_end", "_peak"});
}

void run_relaxation(const PillarScene& scene, SceneAnswer& answer) {
  run_quasi_static(scene, Control::kDisplacement, answer);
}

double modulus_lost(const PronySeries& series, double time_s) {
  return 1.0 - relaxation_modulus_Pa(series, time_s) / instantaneous_modulus_Pa(series);
}

EffectEstimate relaxation_lost(const PillarScene& scene, const EffectEstimate&) {
  return relaxation_over_history(scene, modulus_lost);
}

}  // namespace

Analysis relaxation_analysis() {
  return {.name = "relaxation",
          .drive = RelaxationDrive{},
          .relaxes = true,
          .history = HistoryOf::kShortening,
          .check = check_quasi_static,
          .result_names = relaxation_names,
          .run = run_relaxation,
          .relaxation = relaxation_lost};
}

}  // namespace viscard
