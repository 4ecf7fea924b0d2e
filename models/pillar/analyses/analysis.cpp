#include "models/pillar/analyses/analysis.h"

#include "models/pillar/analyses/top_load.h"

#include <algorithm>
#include <stdexcept>

namespace viscard {

const std::vector<Analysis>& analyses() {
  static const std::vector<Analysis> kAnalyses = {
      {AnalysisKind::kStatic, "static", false, false, check_static, run_static},
      {AnalysisKind::kModal, "modal", true, false, check_modal, run_modal},
      {AnalysisKind::kBuckling, "buckling", false, false, check_buckling, run_buckling},
      {AnalysisKind::kRelaxation, "relaxation", false, true, check_history,
       run_creep_or_relaxation},
      {AnalysisKind::kCreep, "creep", false, true, check_history, run_creep_or_relaxation},
      {AnalysisKind::kHarmonic, "harmonic", true, true, check_harmonic, run_harmonic},
      {AnalysisKind::kTransient, "transient", true, true, check_transient, run_transient_scene},
  };
  return kAnalyses;
}

const Analysis& analysis_of(AnalysisKind kind) {
  for (const Analysis& analysis : analyses()) {
    if (analysis.kind == kind) return analysis;
  }
  throw std::invalid_argument("there is no such analysis");
}

PillarMedia media_of(const Scene& scene) {
  return {isotropic_medium(scene.pillar.E0_Pa, scene.pillar.nu, scene.pillar.rho_kg_m3),
          scene.film};
}

Motion axial_motion(const Scene& scene) {
  return scene.plane ? Motion::kPlaneSymmetric : Motion::kLongitudinal;
}

namespace {

bool is_pressed_by_plate(const Scene& scene, Motion motion) {
  if (scene.kind == AnalysisKind::kBuckling) return scene.plate_on_top;
  return moves_top(scene) && motion == axial_motion(scene);
}

}  // namespace

ModelOptions options_of(const Scene& scene, Motion motion) {
  return {.motion = motion,
          .plane = scene.plane.value_or(PlaneState::kStrain),
          .fixed_bottom = scene.fixed_bottom,
          .pin_bottom = !scene.fixed_bottom && scene.kind == AnalysisKind::kStatic,
          .rigid_top = is_pressed_by_plate(scene, motion),
          .condense_pressures_from = scene.condense_pressures_from};
}

void count_unknowns(const PillarModel& model, SceneAnswer& answer) {
  answer.unknowns = std::max(answer.unknowns, model.system().size());
}

PillarModel model_of(const Scene& scene, Motion motion, const SceneAnswer& answer) {
  return PillarModel(scene.geometry, answer.discretisation, media_of(scene),
                     options_of(scene, motion));
}

}  // namespace viscard
