#pragma once

#include "models/pillar/body/pillar_model.h"
#include "models/pillar/body/pillar_modes.h"
#include "models/pillar/scene/pillar_scene.h"

#include <memory>

namespace viscard {

// Modes under a pressure on the top. Modes of a strip are computed without load.
bool is_pressed(const PillarScene& scene);

// The model whose stress stiffens or softens the modes, or null without a pressure. A pressure at
// rest has acted for a long time: the stress is computed with the long-term moduli, unless the
// pillar buckles earlier.
std::unique_ptr<PillarModel> pressed_model(const PillarScene& scene, const Discretisation& mesh);
// The same as a pillar that answers others to first order, solved.
std::unique_ptr<NearbyPillar> nearby_pressed_model(const PillarScene& scene,
                                                   const Discretisation& mesh);

// Called if the pillar buckles on a mesh: throws std::runtime_error if the pillar itself, whose
// buckling pressure is found on finer meshes, buckles under its pressure, otherwise MeshTooCoarse.
[[noreturn]] void judge_buckling(const PillarScene& scene, const BeyondBuckling& here);

}  // namespace viscard
