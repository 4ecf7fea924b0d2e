#pragma once

#include "models/answer/scene_answer.h"

#include <map>
#include <string>
#include <vector>

namespace viscard {

// What a scene requests for one effect; the plan decides on effects that it does not name (kAuto).
enum class EffectChoice { kAuto, kOn, kOff };
using EffectChoices = std::map<std::string, EffectChoice>;  // by name, effects.h

// Role of an effect in a scene.
enum class EffectRole {
  kAbsent,    // the scene contains nothing on which it could act: off, without error
  kOptional,  // the estimate decides
  kNeeded,    // the results asked for do not exist without it
  kOutside    // no analysis can compute it; the estimate bounds its influence, as a warning
};

// A-priori estimate of leaving an effect out, from the scene's numbers alone; nothing is solved.
// models/scene/README.md lists the formulas and their sources.
struct EffectEstimate {
  EffectRole role = EffectRole::kAbsent;
  double error = 0.0;  // largest relative error of the results if the effect is left out
  std::string number;  // the number that decides, such as "E A/(k L)"
  double value = 0.0;  // of that number
  std::string reason;  // one clause
  // What forcing it off declares, where that is another task and no approximation: then it is no error of the answer,
  // and a note says how far the two lie apart.
  std::string declared_off;
};

// The estimate of one effect.
struct NamedEstimate {
  std::string name;
  EffectEstimate estimate;
};

// The effects that are taken into account, and the errors of leaving out the others.
struct EffectDecisions {
  std::vector<SceneEffect> effects;  // in the order of the estimates
  double left_out = 0.0;             // sum of the estimates of effects left out
};

// The mesh gets the rest of the tolerance, at least this share.
constexpr double kShareOfMesh = 0.5;

// Leaves out the effects with the smallest estimates as long as their sum stays within half the
// tolerance. Throws SceneMistake for a choice that names an unknown effect, forces off an effect
// that the results need or forces on one that no analysis can compute.
EffectDecisions decide_effects(const std::vector<NamedEstimate>& estimates,
                               const EffectChoices& choices, double tolerance);

// Adds the estimates of the effects left out to every error estimate, and a note for each effect
// that the error estimates cannot contain.
void report_left_out(const EffectDecisions& decisions, double tolerance, SceneAnswer& answer);

// Whether an effect may change the results although it is neither computed nor part of their errors.
bool is_missing(const SceneEffect& effect);
// The largest effect that is not computed, missing or forced off by the scene; null: there is none.
const SceneEffect* largest_not_computed(const SceneAnswer& answer);

// Whether no effect that is not computed may change the results by more than the tolerance.
bool effects_within_tolerance(const SceneAnswer& answer, double tolerance);
// Why the results are not within the tolerance: the largest effect that is not computed, or else their errors. Empty:
// they are. Every interface shows this text first.
std::string tolerance_doubt(const SceneAnswer& answer, double tolerance);
// The keys that state how the answer stands to its tolerance.
void show_tolerance(ResultVisitor& v, const SceneAnswer& answer, double tolerance);

// Decides for every answer, whichever analysis made it, if all its error estimates are within the
// tolerance, and says so in `within_tolerance`. Throws std::runtime_error with the worst number
// unless effects that the scene itself forces off are the reason; that gets a note.
void require_tolerance(double tolerance, SceneAnswer& answer);

}  // namespace viscard
