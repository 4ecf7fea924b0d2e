#pragma once

#include "models/array/plane/array_scene.h"

#include <vector>

namespace viscard {

// Which effects a row of pillars is answered with, before anything is solved. The names are those
// of one pillar's effects (pillar/effects.h).
struct ArrayPlan {
  std::vector<SceneEffect> effects;
  ArrayScene reduced;     // a scene that never had the effects that are off
  double left_out = 0.0;  // sum of their estimates, relative
};

// As plan_effects() does for one pillar. Throws SceneMistake.
ArrayPlan plan_effects(const ArrayScene& scene);

// The scene with every effect forced on that the plan might leave out.
ArrayScene with_all_effects_on(const ArrayScene& scene);

// simulate_array() of the reduced scene; what is left out is part of every error estimate.
SceneAnswer simulate_array_planned(const ArrayScene& scene);

}  // namespace viscard
