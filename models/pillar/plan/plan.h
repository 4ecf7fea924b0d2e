#pragma once

#include "models/pillar/scene/scene.h"

#include <vector>

namespace viscard {

// Which effects a scene is answered with, before anything is solved.
struct ScenePlan {
  std::vector<SceneEffect> effects;  // all of effects(), in their order
  Scene reduced;                     // a scene that never had the effects that are off
  double left_out = 0.0;             // sum of their estimates, relative
};

// Leaves out the effects of least estimate as long as their sum stays within half the tolerance;
// the mesh gets the rest. Throws SceneMistake naming an unknown effect, one that is forced off
// though what is asked for does not exist without it, or one forced on that no analysis can have.
ScenePlan plan_effects(const Scene& scene);

// The scene with every effect forced on that the plan might leave out, except incompressibility,
// which is another kind of element and not another answer.
Scene with_all_effects_on(const Scene& scene);

// Answers the scene with the effects of its plan: simulate() of the reduced scene. What is left out
// is part of every error estimate; effects that no analysis can have and that may exceed the
// tolerance are told in the notes.
SceneAnswer simulate_planned(const Scene& scene);

}  // namespace viscard
