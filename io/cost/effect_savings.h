#pragma once

#include "io/cost/cost_clock.h"
#include "models/answer/scene_answer.h"
#include "models/scene/scene.h"

#include <functional>
#include <string>
#include <vector>

namespace viscard {

class ResultVisitor;

// Savings by leaving one effect out: the scene with all effects on, and without this one, on the
// same mesh.
struct EffectSaving {
  std::string effect;
  std::string discretisation;
  int unknowns = 0, unknowns_without = 0;  // of the largest system
  double cpu_s = 0.0, cpu_s_without = 0.0;
};

// What viscard plan shows of a scene.
struct ShownPlan {
  std::vector<SceneEffect> effects;
  std::vector<EffectSaving> savings;
  double left_out = 0.0, tolerance = 0.0, mesh_tolerance = 0.0;  // relative
};
void show_keys(ResultVisitor& v, const ShownPlan& plan);

// Solves the scene once with all effects and once without each that the plan may leave out, on a
// graded mesh of degree 4, or of degree 2 if that takes more than half a second; what this much processor
// time does not allow is left out. Empty if there is no choice.
std::vector<EffectSaving> effect_savings(const Scene& scene, double limit_s = 4.0,
                                         const CostClock& clock = process_clock());

}  // namespace viscard
