#include "models/pillar/analyses/analysis.h"
#include "models/pillar/body/pillar_modes.h"
#include "models/pillar/body/rigid_motion.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace viscard {

std::vector<ModeFamily> mode_families(const Scene& scene) {
  if (scene.plane) {
    return {{"lateral", Motion::kPlaneAntisymmetric, 0},
            {"longitudinal", Motion::kPlaneSymmetric, 0}};
  }
  return {{"lateral", Motion::kLateral, 1},
          {"longitudinal", Motion::kLongitudinal, 0},
          {"torsion", Motion::kTorsion, 0},
          {"ovalling", Motion::kOvalling, 2}};
}

std::vector<PillarMode> family_modes(const Scene& scene, const ModeFamily& family,
                                     const PillarModel& model, const SceneAnswer& on_mesh) {
  const bool pressed = scene.pressure_Pa != 0.0 && family.motion == Motion::kLateral;
  const int rigid = scene.fixed_bottom ? 0 : rigid_motion_count(family.motion);
  const int wanted = std::min(scene.modes, model.system().size() - rigid);
  return pressed ? modes_under_pressure(model_of(scene, Motion::kLongitudinal, on_mesh), model,
                                        scene.pressure_Pa, wanted)
                 : lowest_modes(model, wanted);
}

void check_modal(const Scene& scene) {
  if (scene.modes < 1 || scene.modes > 40) {
    throw std::invalid_argument("modes: " + std::to_string(scene.modes) +
                                " per family; it must lie between 1 and 40");
  }
}

namespace {

// A free body moves as a whole at no frequency at all.
void note_rigid_motions(const Scene& scene, SceneAnswer& answer) {
  if (scene.fixed_bottom) return;
  std::string list;
  int all = 0;
  for (const ModeFamily& family : mode_families(scene)) {
    const int directions = family.harmonic > 0 ? 2 : 1;  // sideways along x and along y
    const int count = directions * rigid_motion_count(family.motion);
    if (count > 0) list += (all > 0 ? ", " : "") + std::to_string(count) + " " + family.name;
    all += count;
  }
  answer.notes.push_back("the bottom is free: " + std::to_string(all) +
                         " motions of the body as a whole (" + list +
                         ") have no frequency and are left out");
}

}  // namespace

void run_modal(const Scene& scene, SceneAnswer& answer) {
  // The n-th mode of a clamped bar has n - 1/2 half waves; an element for each lets the lowest
  // degrees see them all, so that no mesh is refined for want of one.
  if (!scene.discretisation) {
    answer.discretisation.longest_m = scene.geometry.length_m / (scene.modes - 0.5);
  }
  for (const ModeFamily& family : mode_families(scene)) {
    const PillarModel model = model_of(scene, family.motion, answer);
    count_unknowns(model, answer);
    for (const PillarMode& mode : family_modes(scene, family, model, answer)) {
      answer.modes.push_back({family.name, family.harmonic, mode.frequency_Hz, 0.0});
    }
  }
  note_rigid_motions(scene, answer);
}

}  // namespace viscard
