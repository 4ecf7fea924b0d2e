#pragma once

#include "models/scene/common/effect_choice.h"
#include "models/scene/common/effect_estimate.h"
#include "models/scene/common/scene_answer.h"

#include <string>
#include <vector>

namespace viscard {

struct NamedEstimate {
  std::string name;
  EffectEstimate estimate;
};

struct EffectDecisions {
  std::vector<SceneEffect> effects;  // in the order of the estimates
  double left_out = 0.0;             // sum of the estimates of what is left out
};

// The mesh gets what the effects do not take of the tolerance, at least this share.
constexpr double kShareOfMesh = 0.5;

// Leaves out the effects of least estimate as long as their sum stays within half the tolerance.
// Throws SceneMistake for a choice that names an unknown effect, forces off what the question needs
// or forces on what no analysis can have.
EffectDecisions decide_effects(const std::vector<NamedEstimate>& estimates,
                               const EffectChoices& choices, double tolerance);

// Adds what is left out to every error estimate, and a note for each effect that the estimates
// cannot contain.
void report_left_out(const EffectDecisions& decisions, double tolerance, SceneAnswer& answer);

}  // namespace viscard
