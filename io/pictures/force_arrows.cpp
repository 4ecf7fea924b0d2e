#include "io/pictures/force_arrows.h"

#include <cstddef>
#include <map>
#include <utility>

namespace viscard {

std::vector<ForceArrow> force_arrows(const SceneArray& array, const SceneMap& along_x,
                                     const SceneMap& along_y, int per_block) {
  struct Block {
    ForceArrow sum;
    int count = 0;
  };
  std::map<std::pair<int, int>, Block> blocks;
  for (std::size_t at = 0; at < along_x.value.size(); ++at) {
    const ScenePillar& one = array.pillars[along_x.pillar[at]];
    Block& block = blocks[{(one.row - 1) / per_block, (one.column - 1) / per_block}];
    block.sum.x_m += one.x_m;
    block.sum.y_m += one.y_m;
    block.sum.force_x_N += along_x.value[at];
    block.sum.force_y_N += along_y.value[at];
    ++block.count;
  }
  std::vector<ForceArrow> arrows;
  for (const auto& [place, block] : blocks) {
    const double n = block.count;
    arrows.push_back(
        {block.sum.x_m / n, block.sum.y_m / n, block.sum.force_x_N / n, block.sum.force_y_N / n});
  }
  return arrows;
}

}  // namespace viscard
