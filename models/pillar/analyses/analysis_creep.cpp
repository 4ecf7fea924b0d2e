#include "models/material/hereditary.h"
#include "models/material/retardation_spectrum.h"
#include "models/pillar/analyses/analysis.h"
#include "models/pillar/analyses/pillar_results.h"
#include "models/pillar/analyses/quasi_static_history.h"

#include <algorithm>

namespace viscard {
namespace {

std::vector<std::string> creep_names(const PillarScene& scene) {
  return moving_names(scene, "top_displacement", {"_end", "_peak"});
}

void run_creep(const PillarScene& scene, SceneAnswer& answer) {
  run_quasi_static(scene, Control::kForce, answer);
}

double creep_push_Pa(const PillarScene& scene) {
  double largest_Pa = 0.0;
  for (const HistoryPoint& point : history(scene)) largest_Pa = std::max(largest_Pa, point.value);
  return largest_Pa;
}

double compliance_gained(const PronySeries& series, double time_s) {
  const double E0_Pa = instantaneous_modulus_Pa(series);
  return creep_compliance_1_Pa(retardation_from_relaxation(series), time_s) * E0_Pa - 1.0;
}

EffectEstimate creep_relaxation(const PillarScene& scene, const EffectEstimate&) {
  return relaxation_over_history(scene, compliance_gained);
}

}  // namespace

Analysis creep_analysis() {
  return {.name = "creep",
          .drive = CreepDrive{},
          .relaxes = true,
          .history = HistoryOf::kPressure,
          .check = check_quasi_static,
          .result_names = creep_names,
          .run = run_creep,
          .push_Pa = creep_push_Pa,
          .relaxation = creep_relaxation};
}

}  // namespace viscard
