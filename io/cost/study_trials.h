#pragma once

#include "models/scene/common/scene_answer.h"
#include "models/scene/scene.h"

#include <functional>
#include <string>
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

}  // namespace viscard
