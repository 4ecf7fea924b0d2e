#pragma once

#include "models/pillar/scene/pillar_scene.h"
#include "models/scene/common/scene_answer.h"

#include <functional>

namespace viscard {

// Between this Poisson ratio and 0.5 rounding in the large bulk modulus spoils the shear; 0.5 itself is
// solved by another method, without it (models/pillar/README.md, eq. 14).
constexpr double kLastPoissonRatio = 0.499999;

bool is_near_incompressible(const PillarScene& scene);

// Answers such a scene from those at either end, which `answer_on` gives on one mesh: linearly in 1 - 2 nu, of
// which a body's displacements, frequencies and loads are smooth functions. What that may be wrong by is
// part of the errors that every mesh has. Throws std::runtime_error if the ends have not the same results.
SceneAnswer near_incompressible_answer(
    const PillarScene& scene, const std::function<SceneAnswer(const PillarScene&)>& answer_on);

}  // namespace viscard
