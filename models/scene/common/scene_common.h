#pragma once

#include "models/material/material.h"
#include "models/scene/common/effect_choice.h"

#include <functional>
#include <string>
#include <vector>

namespace viscard {

// What every kind of scene has. Each kind of scene derives from this.
struct SceneCommon {
  double tolerance = 1e-3;          // relative error of the results
  Material pillar;                  // of every pillar
  std::vector<std::string> wanted;  // names of results; empty: all
  EffectChoices effects;            // what the plan may not decide itself

  std::function<void(double)> progress;  // called with the fraction done; may be empty
};

// True when the scene asks for this result; a scene that names no results asks for all.
bool asks_for(const SceneCommon& scene, const std::string& result);

// The tolerances that a kind of scene can be answered with: from `least` to below 1.
struct ToleranceRange {
  double least = 0.0;
  const char* words = "";  // for messages: "1e-9 and 1"
  bool contains(double tolerance) const { return tolerance >= least && tolerance < 1.0; }
};

// Throws SceneMistake naming the limits.
void check_tolerance(double tolerance, const ToleranceRange& range);

}  // namespace viscard
