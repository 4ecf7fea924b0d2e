#pragma once

#include "models/answer/scene_answer.h"

#include <vector>

namespace viscard {

// A force along the plane, at the middle of the pillars that it stands for.
struct ForceArrow {
  double x_m = 0.0, y_m = 0.0;
  double force_x_N = 0.0, force_y_N = 0.0;  // mean of its pillars
};

// One arrow for each pillar, or for each block of `per_block` x `per_block` rows and columns. The maps have a value for
// each pillar.
std::vector<ForceArrow> force_arrows(const SceneArray& array, const SceneMap& along_x,
                                     const SceneMap& along_y, int per_block);

}  // namespace viscard
