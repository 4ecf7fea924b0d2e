#include "models/scene/common/scene_common.h"

#include "models/pillar/mesh/number_text.h"
#include "models/pillar/mesh/scene_mistake.h"

#include <algorithm>

namespace viscard {

bool asks_for(const SceneCommon& scene, const std::string& result) {
  // "reading" also asks for "reading_end", which is read off its curve, and the other way round.
  return scene.wanted.empty() ||
         std::any_of(scene.wanted.begin(), scene.wanted.end(), [&](const std::string& wanted) {
           return wanted == result || wanted.starts_with(result + "_") ||
                  result.starts_with(wanted + "_");
         });
}

void check_tolerance(double tolerance, const ToleranceRange& range) {
  if (range.contains(tolerance)) return;
  throw SceneMistake("tolerance", "the tolerance is " + number_text(tolerance) +
                                      "; it must lie between " + range.words);
}

}  // namespace viscard
