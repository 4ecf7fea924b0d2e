#pragma once

#include "models/answer/scene_answer.h"
#include "models/pillar/scene/pillar_scene.h"

#include <functional>

namespace viscard {

// Whether a Poisson ratio is so close to 0.5 that the bulk modulus changes the answer by little beside the
// tolerance.
bool is_near_incompressible(const PillarScene& scene);

// Answers such a scene as that of nu = 0.5, which `answer_on` gives on one mesh. What the finite bulk modulus
// changes, of the order of 1 - 2 nu, is part of the errors that every mesh has.
SceneAnswer near_incompressible_answer(
    const PillarScene& scene, const std::function<SceneAnswer(const PillarScene&)>& answer_on);

}  // namespace viscard
