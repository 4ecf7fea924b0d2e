#pragma once

#include "models/pillar/mesh/pillar_mesh.h"
#include "models/scene/common/scene_answer.h"
#include "models/scene/scene.h"

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace viscard {

// One row of a cost study to come.
struct CostTrial {
  std::string discretisation, effects;
  Discretisation mesh;
  std::function<SceneAnswer()> run;
};

// Everything a study runs: the reference, the same on a mesh of one degree less, and the rows,
// cheap ones of every kind first, so that a short budget still shows something of each.
struct CostTrials {
  std::function<SceneAnswer()> reference, coarser_reference;
  std::vector<CostTrial> rows;
};
CostTrials trials_of(const Scene& scene);

// The meshes that a cost study of a scene compares, by kind of scene.
struct CostMeshes {
  double diameter_m = 0.0;
  std::vector<std::pair<int, int>> graded;  // degrees and layers
  int highest_uniform = 0;                  // degree of equal elements; 0: graded ones alone
  int uniform_layers = 1;
  int reference_layers = 0;
  double step_tolerance = 0.0;    // of the time steps of the reference
  bool takes_time_steps = false;  // through a history; rows are solved by a transform
};
CostMeshes cost_meshes(const Scene& scene);

Discretisation graded_mesh(const Scene& scene, int degree, int layers);
// The mesh that equal elements start from; the caller sets their size.
Discretisation uniform_mesh(const Scene& scene, int degree);
// The mesh for a scene that an effect was left out of.
Discretisation mesh_without_effect(const Scene& without, Discretisation mesh);

}  // namespace viscard
