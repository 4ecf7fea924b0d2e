#include "models/pillar/plan.h"

#include "models/pillar/effects.h"
#include "models/pillar/relaxed_modes.h"
#include "models/pillar/scene_mistake.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <stdexcept>
#include <string>

namespace viscard {
namespace {

constexpr double kShareOfEffects = 0.5;  // of the tolerance; the mesh gets the rest

EffectChoice choice_of(const Scene& scene, const std::string& name) {
  const auto found = scene.effects.find(name);
  return found == scene.effects.end() ? EffectChoice::kAuto : found->second;
}

void refuse_unknown(const Scene& scene) {
  const std::vector<std::string> names = effect_names();
  for (const auto& [name, choice] : scene.effects) {
    if (std::find(names.begin(), names.end(), name) == names.end()) {
      throw SceneMistake("effects." + name, "there is no effect '" + name + "'");
    }
  }
}

std::string percent(double share) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2g %%", 100.0 * share);
  return text;
}

// Fills everything but what the budget decides.
SceneEffect decided_by_role(const Effect& effect, const EffectEstimate& estimate,
                            EffectChoice choice) {
  SceneEffect decision{effect.name,    false,           estimate.reason,
                       estimate.error, estimate.number, estimate.value};
  decision.is_forced = choice != EffectChoice::kAuto;
  switch (estimate.role) {
    case EffectRole::kAbsent:
      if (choice == EffectChoice::kOn) decision.reason += "; switching it on changes nothing";
      decision.is_forced = false;
      break;
    case EffectRole::kOutside:
      if (choice == EffectChoice::kOn) {
        throw SceneMistake("effects." + decision.name,
                           "cannot be on: no analysis of this kind can have it (" +
                               estimate.reason + "). It would change the results by up to " +
                               percent(estimate.error) + "; say \"auto\" to be warned of it");
      }
      decision.is_forced = false;
      break;
    case EffectRole::kNeeded:
      if (choice == EffectChoice::kOff) {
        throw SceneMistake("effects." + decision.name, "cannot be off: " + estimate.reason);
      }
      decision.on = true;
      break;
    case EffectRole::kOptional:
      decision.on = choice == EffectChoice::kOn;
      decision.is_counted = choice == EffectChoice::kOff;
      break;
  }
  return decision;
}

// Switches on what the budget cannot bear, the least errors being left out first.
double spend_budget(double tolerance, const std::vector<EffectEstimate>& estimates,
                    std::vector<SceneEffect>& decisions) {
  double left_out = 0.0;
  std::vector<std::size_t> open;
  for (std::size_t i = 0; i < decisions.size(); ++i) {
    if (decisions[i].is_counted) left_out += decisions[i].estimate;
    if (estimates[i].role == EffectRole::kOptional && !decisions[i].is_forced) open.push_back(i);
  }
  std::sort(open.begin(), open.end(),
            [&](auto a, auto b) { return decisions[a].estimate < decisions[b].estimate; });
  for (const std::size_t i : open) {
    SceneEffect& decision = decisions[i];
    decision.is_counted = left_out + decision.estimate <= kShareOfEffects * tolerance;
    decision.on = !decision.is_counted;
    if (decision.is_counted) left_out += decision.estimate;
  }
  return left_out;
}

void add_left_out(double left_out, SceneAnswer& answer) {
  for (SceneResult& result : answer.results) {
    result.error_estimate += left_out * std::max(std::abs(result.value), result.scale);
  }
  for (SceneMode& mode : answer.modes) mode.error_estimate += left_out * mode.frequency_Hz;
  for (SceneCurve& curve : answer.curves) {
    double peak = 0.0;
    for (const double value : curve.value) peak = std::max(peak, std::abs(value));
    for (double& error : curve.error) error += left_out * peak;
  }
  answer.largest_relative_error += left_out;
}

void add_notes(const Scene& scene, const ScenePlan& plan, SceneAnswer& answer) {
  for (const SceneEffect& effect : plan.effects) {
    if (effect.on || effect.is_counted || effect.estimate <= scene.tolerance) continue;
    answer.notes.push_back(effect.name + ": up to " + percent(effect.estimate) +
                           " that the error estimates do not contain (" + effect.number + " = " +
                           percent(effect.value) + "); " + effect.reason);
  }
  if (plan.left_out > scene.tolerance) {
    answer.notes.push_back("the effects that the scene forces off may change the results by " +
                           percent(plan.left_out) + ", more than the tolerance");
  }
}

}  // namespace

ScenePlan plan_effects(const Scene& scene) {
  validate(scene);
  refuse_unknown(scene);
  ScenePlan plan;
  std::vector<EffectEstimate> estimates;
  for (const Effect& effect : effects()) {
    estimates.push_back(effect.estimate(scene));
    plan.effects.push_back(
        decided_by_role(effect, estimates.back(), choice_of(scene, effect.name)));
  }
  plan.left_out = spend_budget(scene.tolerance, estimates, plan.effects);
  plan.reduced = scene;
  for (std::size_t i = 0; i < estimates.size(); ++i) {
    const Effect& effect = effects()[i];
    if (plan.effects[i].is_counted && effect.leave_out != nullptr) effect.leave_out(plan.reduced);
    if (plan.effects[i].on && plan.effects[i].is_forced && effect.insist != nullptr) {
      effect.insist(plan.reduced);
    }
  }
  plan.reduced.tolerance =
      std::max(scene.tolerance - plan.left_out, kShareOfEffects * scene.tolerance);
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
  add_left_out(plan.left_out, answer);
  add_notes(scene, plan, answer);
  answer.effects = plan.effects;
  return answer;
}

}  // namespace viscard
