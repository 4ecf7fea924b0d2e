#pragma once

#include "models/pillar/body/pillar_model.h"
#include "models/pillar/body/pillar_modes.h"
#include "models/pillar/scene/pillar_scene.h"

#include <memory>

namespace viscard {

// Modes under a pressure on the top. Those of a strip are computed without load.
bool is_pressed(const PillarScene& scene);

// The model whose stress stiffens or softens the modes, or null without a pressure. A pressure at
// rest has been there for long: the stress is that of the long-term moduli, unless the pillar
// buckles before it comes to that.
std::unique_ptr<PillarModel> pressed_model(const PillarScene& scene, const Discretisation& mesh);

// What a mesh on which the pillar buckles says: throws std::runtime_error if the pillar itself,
// whose buckling pressure is found on finer meshes, buckles under its pressure, else MeshTooCoarse.
[[noreturn]] void judge_buckling(const PillarScene& scene, const BeyondBuckling& here);

}  // namespace viscard
