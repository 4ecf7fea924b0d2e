#include "models/pillar/analyses/analysis.h"

#include "models/pillar/analyses/top_load.h"

#include <algorithm>
#include <stdexcept>

namespace viscard {

const std::vector<Analysis>& analyses() {
  static const std::vector<Analysis> kAnalyses = {
      static_analysis(), modal_analysis(),    buckling_analysis(),  relaxation_analysis(),
      creep_analysis(),  harmonic_analysis(), transient_analysis(),
  };
  return kAnalyses;
}

const Analysis& analysis_of(const PillarScene& scene) {
  for (const Analysis& analysis : analyses()) {
    if (analysis.drive.index() == scene.drive.index()) return analysis;
  }
  throw std::logic_error("this drive has no row in the table of analyses");
}

PillarMedia media_of(const PillarScene& scene) {
  return {isotropic_medium(scene.pillar.E0_Pa, scene.pillar.nu, scene.pillar.rho_kg_m3),
          scene.film};
}

Motion axial_motion(const PillarScene& scene) {
  return scene.plane ? Motion::kPlaneSymmetric : Motion::kLongitudinal;
}

Motion lateral_motion(const PillarScene& scene) {
  return scene.plane ? Motion::kPlaneAntisymmetric : Motion::kLateral;
}

ModelOptions options_of(const PillarScene& scene, Motion motion) {
  const bool is_pressed_by_plate =
      plate_on_top(scene) || (moves_top(scene) && motion == axial_motion(scene));
  const bool is_pinned =
      !scene.fixed_bottom && analysis_of(scene).free_bottom == FreeBottom::kPinned;
  return {.motion = motion,
          .plane = scene.plane.value_or(PlaneState::kStrain),
          .fixed_bottom = scene.fixed_bottom,
          .pin_bottom = is_pinned,
          .rigid_top = is_pressed_by_plate,
          .condense_pressures_from = scene.condense_pressures_from};
}

void count_unknowns(const PillarModel& model, SceneAnswer& answer) {
  answer.unknowns = std::max(answer.unknowns, model.system().size());
}

PillarModel model_of(const PillarScene& scene, Motion motion, const SceneAnswer& answer) {
  return PillarModel(scene.geometry, answer.discretisation, media_of(scene),
                     options_of(scene, motion));
}

}  // namespace viscard
