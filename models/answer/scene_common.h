#pragma once

#include "models/answer/effect_estimate.h"
#include "models/answer/surroundings.h"
#include "models/material/film_loss.h"
#include "models/material/material.h"

#include <functional>
#include <string>
#include <vector>

namespace viscard {

// The base of every kind of scene.
struct SceneCommon {
  double tolerance = 1e-3;          // relative error of the results
  Material pillar;                  // of every pillar
  FilmLoss film_loss;               // of a film with electrodes
  std::vector<std::string> wanted;  // names of results; empty: all
  EffectChoices effects;            // choices that the plan must respect
  Surroundings surroundings;

  // Called with the fraction done and what is done next; may be empty.
  std::function<void(double, const std::string&)> progress;
};

// True when the scene asks for this result; a scene that names no results asks for all.
bool asks_for(const SceneCommon& scene, const std::string& result);

// The tolerances that a kind of scene supports: from `least` to below 1.
struct ToleranceRange {
  double least = 0.0;      // relative
  const char* words = "";  // for messages: "1e-9 and 1"
  // True if scenes support the tolerance.
  bool contains(double tolerance) const { return tolerance >= least && tolerance < 1.0; }
};

// Throw SceneMistake: for a tolerance outside the range; unless there are frequencies, positive and
// ascending; for an end or a number of outputs that a transient analysis cannot have.
void check_tolerance(double tolerance, const ToleranceRange& range);
void check_frequencies(const std::vector<double>& frequencies_Hz);
void check_outputs(double end_time_s, int outputs);

}  // namespace viscard
