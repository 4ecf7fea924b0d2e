#pragma once

#include "models/answer/scene_answer.h"
#include "models/pillar/scene/pillar_scene.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace viscard {

// Throws std::invalid_argument, mostly SceneMistake, naming what is missing or contradictory.
void validate(const PillarScene& scene);

// Everything a scene may ask for under [want]: the names of its results, and the names of its
// curves. A curve's name also selects the results read off it. Nothing is solved.
// tests/models/scene compares this list with the results of the analyses.
std::vector<std::string> result_names(const PillarScene& scene);

// Answers the scene as it stands, with the effects it names: on meshes of rising degree and grading
// until every result meets the tolerance (error_control.h). Throws SceneMistake for a load beyond
// buckling, std::runtime_error with the reason if the finest mesh does not meet the tolerance.
SceneAnswer simulate_pillar(const PillarScene& scene);

// The same on one mesh, without mesh errors.
SceneAnswer pillar_answer_on(const PillarScene& scene, const Discretisation& mesh);

// Answers on the mesh, to first order in the difference, of scenes that differ from this one in
// quantities alone. The scene is solved once, and every answer reuses its solutions: models/pillar/README.md,
// eq. 26. Empty if the analysis has no such answers. There is none where only an answer of its own will
// do: if the mesh gets other elements, and for other lengths at nu = 0.5.
using FirstOrderAnswers = std::function<std::optional<SceneAnswer>(const PillarScene&)>;
FirstOrderAnswers first_order_answers(const PillarScene& scene, const Discretisation& mesh);

}  // namespace viscard
