#pragma once

#include "models/answer/scene_answer.h"
#include "models/array/plane/row_shapes.h"

#include <string>
#include <utility>
#include <vector>

namespace viscard {

// Pictures of the modes of a row, name ("lateral_1") and SVG: each pillar at rest and moved, the
// motion of its top with sign below it, the frequency of `modes` (those of the answer, in the same
// order) and `scene`, its name, in the title. Of each cluster the first eight modes; a long row shows its first and its last
// pillars.
std::vector<std::pair<std::string, std::string>> pictures_from_shapes(
    const RowShapes& shapes, const std::vector<SceneMode>& modes, const std::string& scene = "");

}  // namespace viscard
