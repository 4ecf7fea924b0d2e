#pragma once

#include "models/pillar/scene/pillar_scene.h"
#include "models/scene/common/scene_answer.h"

namespace viscard {

// Answers the scene as it stands, with the effects it names: on meshes of rising degree and grading
// until every result meets the tolerance (error_control.h). Throws SceneMistake for a load beyond
// buckling, std::runtime_error with the reason if the finest mesh does not meet the tolerance.
SceneAnswer simulate_pillar(const PillarScene& scene);

// The same on one mesh, without mesh errors.
SceneAnswer pillar_answer_on(const PillarScene& scene, const Discretisation& mesh);

// Changes an answer of simulate_pillar() or pillar_answer_on() once its errors are known, if the
// analysis does that (modes of a material that relaxes).
void finish_pillar(const PillarScene& scene, SceneAnswer& answer);

}  // namespace viscard
