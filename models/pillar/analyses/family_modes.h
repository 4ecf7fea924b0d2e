#pragma once

#include "models/pillar/body/nearby_pillar.h"
#include "models/pillar/body/pillar_modes.h"
#include "models/pillar/scene/pillar_scene.h"
#include "models/pillar/time/relaxed_modes.h"

#include <vector>

namespace viscard {

// A family of motion and its place in the answer.
struct ModeFamily {
  const char* name;
  Motion motion;
  int harmonic;
};
std::vector<ModeFamily> mode_families(const PillarScene& scene);

// The modes of one family that the scene wants, under the stress of `axial` unless it is null: with the
// instantaneous moduli, or with those at their own complex frequencies (eq. 22b). If the scene has nearby
// pillars, those of this family to first order (eq. 26).
std::vector<PillarMode> family_modes(const PillarScene& scene, const PillarModel& model,
                                     const PillarModel* axial);
std::vector<RelaxedMode> family_relaxed_modes(const PillarScene& scene, const PillarModel& model,
                                              const PillarModel* axial);

// The pillars that a modal analysis needs for that (Analysis::solve_nearby).
NearbyPillars modal_nearby(const PillarScene& scene, const Discretisation& mesh);

}  // namespace viscard
