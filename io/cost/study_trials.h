#pragma once

#include "io/cost/study_cost.h"

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
CostTrials trials_of(const ArrayScene& scene);

}  // namespace viscard
