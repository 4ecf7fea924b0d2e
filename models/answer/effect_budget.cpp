#include "models/answer/effect_estimate.h"
#include "models/answer/scene_mistake.h"
#include "models/maths/result_visitor.h"
#include "models/maths/text_of_number.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace viscard {
namespace {

// Ends the reason of an effect that is forced on.
constexpr const char* kChangesNothing = "; switching it on changes nothing";

EffectChoice choice_of(const EffectChoices& choices, const std::string& name) {
  const auto found = choices.find(name);
  return found == choices.end() ? EffectChoice::kAuto : found->second;
}

void refuse_unknown(const std::vector<NamedEstimate>& estimates, const EffectChoices& choices) {
  for (const auto& [name, choice] : choices) {
    const auto is_it = [&name = name](const NamedEstimate& one) { return one.name == name; };
    if (std::none_of(estimates.begin(), estimates.end(), is_it)) {
      throw SceneMistake("effects." + name, "there is no effect '" + name + "'");
    }
  }
}

std::string percent(double share) {
  const bool is_large = std::abs(share) >= 0.995 && std::abs(share) < 1e4;  // "100 %", not 1e+02
  return text_of(is_large ? std::round(100.0 * share) : 100.0 * share, is_large ? 7 : 2) + " %";
}

// Forced off, and no error of the answer, because the scene declares another task with it.
bool is_declared_off(const SceneEffect& effect) {
  return effect.is_forced && !effect.on && !effect.is_counted;
}

// The decision without the budget.
SceneEffect decided_by_role(const std::string& name, const EffectEstimate& estimate,
                            EffectChoice choice) {
  SceneEffect decision{name,           false,           estimate.reason,
                       estimate.error, estimate.number, estimate.value};
  decision.is_forced = choice != EffectChoice::kAuto;
  decision.is_choice = estimate.role == EffectRole::kOptional &&
                       (estimate.error > 0.0 || choice != EffectChoice::kAuto);
  decision.is_outside = estimate.role == EffectRole::kOutside;
  switch (estimate.role) {
    case EffectRole::kAbsent:
      if (choice == EffectChoice::kOn) {
        decision.reason += kChangesNothing;
      }
      decision.is_forced = false;
      break;
    case EffectRole::kOutside:
      if (choice == EffectChoice::kOn) {
        throw SceneMistake("effects." + decision.name,
                           "cannot be on: no analysis of this kind can compute it (" +
                               estimate.reason + "). It would change the results by up to " +
                               percent(estimate.error) + "; use \"auto\" for a warning");
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
      decision.is_counted = choice == EffectChoice::kOff && estimate.declared_off.empty();
      if (choice == EffectChoice::kOff && !decision.is_counted)
        decision.reason = estimate.declared_off;
      break;
  }
  return decision;
}

// Leaves out the smallest errors first, and switches on those that exceed the budget.
double spend_budget(double tolerance, const std::vector<NamedEstimate>& estimates,
                    std::vector<SceneEffect>& decisions) {
  double left_out = 0.0;
  std::vector<std::size_t> open;
  for (std::size_t i = 0; i < decisions.size(); ++i) {
    if (decisions[i].is_counted) left_out += decisions[i].estimate;
    if (estimates[i].estimate.role == EffectRole::kOptional && !decisions[i].is_forced)
      open.push_back(i);
  }
  std::sort(open.begin(), open.end(),
            [&](auto a, auto b) { return decisions[a].estimate < decisions[b].estimate; });
  for (const std::size_t i : open) {
    SceneEffect& decision = decisions[i];
    decision.is_counted = left_out + decision.estimate <= (1.0 - kShareOfMesh) * tolerance;
    decision.on = !decision.is_counted;
    if (decision.is_counted) left_out += decision.estimate;
  }
  return left_out;
}

void add_left_out(double left_out, SceneAnswer& answer) {
  for (SceneResult& result : answer.results) {
    result.error_estimate += left_out * std::max(std::abs(result.value), result.scale);
  }
  for (SceneMode& mode : answer.modes) {
    mode.error_estimate += left_out * mode.frequency_Hz;
    // A share of the stiffness that does not relax reduces the damping by that share; the frequency
    // changes by half of it.
    if (mode.damping_ratio) mode.damping_error += 2.0 * left_out * *mode.damping_ratio;
  }
  for (SceneCurve& curve : answer.curves) {
    const double peak = largest_size(curve.value);
    for (double& error : curve.error) error += left_out * peak;
  }
  for (SceneMap& map : answer.maps) {
    const double more = left_out * size_of(map);
    for (double& error : map.error) error += more;
  }
  answer.largest_relative_error += left_out;
}

void add_notes(const EffectDecisions& plan, double tolerance, SceneAnswer& answer) {
  for (const SceneEffect& effect : plan.effects) {
    if (effect.reason.ends_with(kChangesNothing))
      answer.notes.push_back(effect.name + " is forced on: " + effect.reason);
    if (is_declared_off(effect))
      answer.notes.push_back(effect.name + ": up to " + percent(effect.estimate) + "; " +
                             effect.reason);
    if (!is_missing(effect) || effect.estimate <= tolerance) continue;
    const std::string number =
        effect.number.empty() ? "" : " (" + effect.number + " = " + percent(effect.value) + ")";
    answer.notes.push_back(effect.name + ": up to " + percent(effect.estimate) +
                           " that the error estimates do not contain" + number + "; " +
                           effect.reason);
  }
  if (plan.left_out > tolerance) {
    answer.notes.push_back("the effects that the scene forces off may change the results by " +
                           percent(plan.left_out) + ", more than the tolerance");
  }
}

}  // namespace

bool is_missing(const SceneEffect& effect) {
  return !effect.on && !effect.is_counted && !is_declared_off(effect) && effect.estimate > 0.0;
}

const SceneEffect* largest_not_computed(const SceneAnswer& answer) {
  const SceneEffect* largest = nullptr;
  for (const SceneEffect& effect : answer.effects) {
    if (!is_missing(effect) && !(effect.is_counted && effect.is_forced)) continue;
    if (largest == nullptr || effect.estimate > largest->estimate) largest = &effect;
  }
  return largest;
}

bool effects_within_tolerance(const SceneAnswer& answer, double tolerance) {
  const SceneEffect* largest = largest_not_computed(answer);
  return largest == nullptr || largest->estimate <= tolerance;
}

std::string tolerance_doubt(const SceneAnswer& answer, double tolerance) {
  if (!effects_within_tolerance(answer, tolerance)) {
    const SceneEffect& largest = *largest_not_computed(answer);
    return "not within the tolerance: " + largest.name +
           " is not computed and may change the results by " +
           text_of(100.0 * largest.estimate, 3) + " %";
  }
  if (answer.within_tolerance) return "";
  return "not within the tolerance: the notes state the errors that exceed it";
}

void show_tolerance(ResultVisitor& v, const SceneAnswer& answer, double tolerance) {
  v("effects_within_tolerance", effects_within_tolerance(answer, tolerance),
    "whether no effect that is not computed may change the results by more than the tolerance");
  v("within_tolerance", answer.within_tolerance, "whether the estimated error meets the tolerance");
  v("tolerance_doubt", tolerance_doubt(answer, tolerance),
    "why the results are not within the tolerance, of both; empty: they are");
}

EffectDecisions decide_effects(const std::vector<NamedEstimate>& estimates,
                               const EffectChoices& choices, double tolerance) {
  refuse_unknown(estimates, choices);
  EffectDecisions decisions;
  for (const NamedEstimate& one : estimates) {
    decisions.effects.push_back(
        decided_by_role(one.name, one.estimate, choice_of(choices, one.name)));
  }
  decisions.left_out = spend_budget(tolerance, estimates, decisions.effects);
  return decisions;
}

void report_left_out(const EffectDecisions& decisions, double tolerance, SceneAnswer& answer) {
  add_left_out(decisions.left_out, answer);
  add_notes(decisions, tolerance, answer);
  answer.effects = decisions.effects;
}

void require_tolerance(double tolerance, SceneAnswer& answer) {
  std::string worst = "answer";
  double largest = answer.largest_relative_error;
  const auto look_at = [&](const std::string& name, double error, double size) {
    if (error <= largest * size) return;
    worst = name;
    largest = error / size;
  };
  for (const SceneResult& r : answer.results) {
    if (r.is_wanted) look_at(r.name, r.error_estimate, std::max(std::abs(r.value), r.scale));
  }
  for (const SceneMode& mode : answer.modes) {
    look_at(mode.family + " frequency", mode.error_estimate, mode.frequency_Hz);
    look_at(mode.family + " damping ratio", mode.damping_error, 1.0);
  }
  answer.within_tolerance = largest <= tolerance * (1.0 + 1e-9);
  if (answer.within_tolerance) return;
  const bool is_declared =
      std::any_of(answer.effects.begin(), answer.effects.end(),
                  [](const SceneEffect& effect) { return effect.is_forced && effect.is_counted; });
  const std::string what = "the " + worst + " has a relative error of about " +
                           text_of(largest, 2) + ", more than the tolerance of " +
                           text_of(tolerance, 2);
  if (!is_declared) throw std::runtime_error(what + "; ask for a larger tolerance");
  answer.notes.push_back(what + ", with the effects that the scene forces off");
}

}  // namespace viscard
