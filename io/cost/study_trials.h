#pragma once

#include "models/answer/scene_answer.h"
#include "models/pillar/mesh/pillar_mesh.h"
#include "models/scene/scene.h"

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace viscard {

inline constexpr const char* kLinearElements = "h1";

// One row of a cost study to come.
struct CostTrial {
  std::string discretisation, effects;
  Discretisation mesh;
  std::function<SceneAnswer()> run;
  std::string kind;   // trials of one kind follow one law of cost: "h1", "h2", "p", "graded p"
  double size = 1.0;  // of the mesh; unknowns are in proportion to it
};

// Everything a study runs: references of rising degree on the same layers, and the rows, cheap ones
// of every kind first, so that a short budget still shows something of each.
struct CostTrials {
  std::vector<CostTrial> references;
  std::vector<CostTrial> rows;
  double tolerance = 0.0;  // of the scene
};
CostTrials trials_of(const Scene& scene);

// The scene with all effects on, then without each effect that the plan might leave out, named by
// the effect, on a graded mesh.
std::vector<CostTrial> effect_trials_on(const Scene& scene, int degree, int layers);

// The meshes that a cost study of a scene compares, by kind of scene.
struct CostMeshes {
  double diameter_m = 0.0;
  std::vector<std::pair<int, int>> graded;  // degrees and layers
  int highest_uniform = 0;                  // degree of equal elements; 0: graded ones alone
  int uniform_layers = 1;
  int reference_layers = 0;
  double step_tolerance = 0.0;    // of the time steps and modes of the reference
  double row_tolerance = 0.0;     // of those of the rows
  bool takes_time_steps = false;  // through a history; rows are solved by a transform
};
CostMeshes cost_meshes(const Scene& scene);

Discretisation graded_mesh(const Scene& scene, int degree, int layers);
// The mesh that equal elements start from; the caller sets their size.
Discretisation uniform_mesh(const Scene& scene, int degree);
// Nodes of the largest system on a mesh, or a number in proportion to them. Nothing is solved.
double mesh_size(const Scene& scene, const Discretisation& mesh);
// The mesh for a scene that an effect was left out of.
Discretisation mesh_without_effect(const Scene& without, Discretisation mesh);

}  // namespace viscard
