#pragma once

#include "models/answer/scene_answer.h"
#include "models/array/plane/row_shapes.h"
#include "models/pillar/body/section_grid.h"
#include "models/scene/scene.h"

#include <functional>
#include <optional>
#include <vector>

namespace viscard {

// Answers a scene with the effects of its plan (plan.h), on meshes of rising degree until every
// result meets the tolerance (error_control.h). The estimates of effects that the plan leaves out
// are part of every error estimate. The notes name effects that no analysis can compute and that
// may exceed the tolerance. Throws SceneMistake for a scene that contradicts itself or whose load
// lies beyond buckling, and std::runtime_error with the reason if the finest mesh does not meet the
// tolerance.
SceneAnswer simulate(const Scene& scene);

// The scene as it stands, with no plan, on one mesh and without mesh errors. Throws SceneMistake for a
// scene that contradicts itself.
SceneAnswer answer_on(const Scene& scene, const Discretisation& mesh);

// Answers on the mesh, to first order in the difference, of scenes that differ from this one in quantities
// alone, as answer_on() gives them: the scene is solved once, and its solutions are reused. Empty if the
// scene has no such answers; other kinds than single pillars have none. There is none where only an answer
// of its own will do (models/pillar/analyses/simulate_pillar.h).
std::function<std::optional<SceneAnswer>(const Scene&)> first_order_answers(
    const Scene& scene, const Discretisation& mesh);

// The solution on a mesh, with the plan's effects, for pictures. Static: displacement (m), axial
// stress (Pa), with electrodes the potential (V). Modal: the shapes of every family, largest
// displacement 1. Other analyses and rows of pillars (mode_shapes()) have none. The scene is solved
// again. Throws as plan_effects() does.
std::vector<SectionGrid> solution_fields(const Scene& scene, const Discretisation& mesh);

// The modes of a row of pillars, with the plan's effects, for pictures; without modes for every
// other scene. The scene is solved anew. Throws as plan_effects() does.
RowShapes mode_shapes(const Scene& scene, const Discretisation& mesh);

// Answers all `points` on all cores; done(i, answer) is called for one at a time, in the order in
// which they end. The first exception is thrown once all running points have ended.
void simulate_all(const std::vector<Scene>& points,
                  const std::function<void(std::size_t, const SceneAnswer&)>& done);

}  // namespace viscard
