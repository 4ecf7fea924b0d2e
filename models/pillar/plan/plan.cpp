#include "models/pillar/plan/plan.h"

#include "models/pillar/plan/effect_budget.h"
#include "models/pillar/plan/effects.h"
#include "models/pillar/plan/relaxed_modes.h"

#include <algorithm>
#include <utility>

namespace viscard {

ScenePlan plan_effects(const Scene& scene) {
  validate(scene);
  std::vector<NamedEstimate> estimates;
  for (const Effect& effect : effects()) estimates.push_back({effect.name, effect.estimate(scene)});
  EffectDecisions decisions = decide_effects(estimates, scene.effects, scene.tolerance);
  ScenePlan plan{std::move(decisions.effects), scene, decisions.left_out};
  for (std::size_t i = 0; i < estimates.size(); ++i) {
    const Effect& effect = effects()[i];
    if (plan.effects[i].is_counted && effect.leave_out != nullptr) effect.leave_out(plan.reduced);
    if (plan.effects[i].on && plan.effects[i].is_forced && effect.insist != nullptr) {
      effect.insist(plan.reduced);
    }
  }
  plan.reduced.tolerance =
      std::max(scene.tolerance - plan.left_out, kShareOfMesh * scene.tolerance);
  return plan;
}

Scene with_all_effects_on(const Scene& scene) {
  Scene all = scene;
  for (const Effect& effect : effects()) {
    if (effect.leave_out == leave_out_incompressibility) continue;
    if (effect.estimate(scene).role != EffectRole::kOptional) continue;
    all.effects[effect.name] = EffectChoice::kOn;
  }
  return all;
}

SceneAnswer simulate_planned(const Scene& scene) {
  const ScenePlan plan = plan_effects(scene);
  SceneAnswer answer = simulate(plan.reduced);
  if (scene.kind == AnalysisKind::kModal) relax_modes(plan.reduced, answer);
  tell_left_out({plan.effects, plan.left_out}, scene.tolerance, answer);
  return answer;
}

}  // namespace viscard
