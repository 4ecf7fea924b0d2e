#pragma once

#include "models/array/plane/array_scene.h"
#include "models/scene/common/scene_answer.h"

#include <string>
#include <vector>

namespace viscard {

// One analysis of a row of pillars: what it needs, what it may be asked for, and its answer on one
// mesh. All other code reads this row and never asks which analysis it is. A new analysis is an
// alternative of RowDrive, a file array_analysis_*.cpp and a row of the table in
// array_analysis.cpp.
struct ArrayAnalysis {
  const char* name;  // the word in a scene file
  RowDrive drive;    // its alternative of the variant, with default values

  bool has_inertia = false;  // vibration: needs densities
  bool relaxes = false;      // in time or frequency, with the Prony series
  bool is_loaded = true;     // false: free vibration

  void (*check)(const ArrayScene& scene) = nullptr;  // throws SceneMistake; may be null
  std::vector<std::string> (*result_names)(const ArrayScene& scene) = nullptr;
  SceneAnswer (*run)(const ArrayScene& scene, const Discretisation& mesh) = nullptr;
  // Throws std::runtime_error for an answer that no mesh improves enough; may be null.
  void (*check_answer)(const ArrayScene& scene, const SceneAnswer& answer) = nullptr;
  // What is done to each pillar when the plan leaves the film out; null: it never does.
  PillarDrive (*alone)(const ArrayScene& scene) = nullptr;
};

const std::vector<ArrayAnalysis>& array_analyses();
const ArrayAnalysis& analysis_of(const ArrayScene& scene);

// True if the scene asks for more than the motion of the tops, and the film has potentials.
bool asks_for_voltages(const ArrayScene& scene);

// The rows of the table, each in its own file.
ArrayAnalysis array_static_analysis();
ArrayAnalysis array_modal_analysis();
ArrayAnalysis array_harmonic_analysis();
ArrayAnalysis array_transient_analysis();

}  // namespace viscard
