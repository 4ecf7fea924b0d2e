#pragma once

#include "models/answer/scene_answer.h"
#include "models/scene/scene.h"

#include <vector>

namespace viscard {

// The effects that a scene is answered with, before anything is solved.
struct ScenePlan {
  std::vector<SceneEffect> effects;  // all of effects(), in their order
  Scene reduced;                     // a scene that never had the effects that are off
  double left_out = 0.0;             // sum of their estimates, relative
};

// Leaves out the effects with the smallest estimates as long as their sum stays within half the
// tolerance; the mesh gets the rest. Throws SceneMistake naming an unknown effect, one forced off
// although the results need it, or one forced on although no analysis can compute it.
ScenePlan plan_effects(const Scene& scene);

// The plan of a scene whose load the straight pillar bears: refuses what plan_effects() and
// refuse_beyond_buckling() refuse.
ScenePlan checked_plan(const Scene& scene);

// The scene with every effect forced on that the plan might leave out, except choices of elements.
Scene with_all_effects_on(const Scene& scene);

}  // namespace viscard
