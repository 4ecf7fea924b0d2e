#include "models/scene/plan.h"

#include "models/answer/effect_estimate.h"
#include "models/scene/effects.h"

#include <algorithm>
#include <utility>

namespace viscard {
namespace {

template <typename Body>
std::vector<NamedEstimate> estimates_of(const Body& scene) {
  std::vector<NamedEstimate> estimates;
  for (const Effect& effect : effects()) {
    estimates.push_back({effect.name, effect_on<Body>(effect).estimate(scene)});
  }
  return estimates;
}

template <typename Body>
Body reduced(Body scene, const EffectDecisions& decisions) {
  const double tolerance = scene.tolerance;
  for (std::size_t i = 0; i < decisions.effects.size(); ++i) {
    const SceneEffect& decision = decisions.effects[i];
    const EffectOn<Body>& effect = effect_on<Body>(effects()[i]);
    const bool is_off = decision.is_counted || (decision.is_forced && !decision.on);
    if (is_off && effect.leave_out != nullptr) effect.leave_out(scene);
    if (decision.on && decision.is_forced && effect.insist != nullptr) effect.insist(scene);
  }
  scene.tolerance =
      std::max({tolerance - decisions.left_out, kShareOfMesh * tolerance, Body::kTolerances.least});
  return scene;
}

template <typename Body>
ScenePlan plan_of(const Body& scene) {
  EffectDecisions decisions = decide_effects(estimates_of(scene), scene.effects, scene.tolerance);
  Scene without = reduced(scene, decisions);
  return {std::move(decisions.effects), std::move(without), decisions.left_out};
}

}  // namespace

ScenePlan plan_effects(const Scene& scene) {
  validate(scene);
  return std::visit([](const auto& body) { return plan_of(body); }, scene);
}

ScenePlan checked_plan(const Scene& scene) {
  refuse_beyond_buckling(scene);
  refuse_buckling_in_creep(scene);
  return plan_effects(scene);
}

Scene with_all_effects_on(const Scene& scene) {
  Scene all = scene;
  std::visit(
      [](auto& body) {
        const auto estimates = estimates_of(body);
        for (std::size_t i = 0; i < estimates.size(); ++i) {
          if (effects()[i].is_choice_of_elements) continue;
          if (estimates[i].estimate.role != EffectRole::kOptional) continue;
          body.effects[estimates[i].name] = EffectChoice::kOn;
        }
      },
      all);
  return all;
}

}  // namespace viscard
