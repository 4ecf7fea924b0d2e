#include "models/answer/scene_common.h"

#include "models/answer/scene_mistake.h"
#include "models/maths/text_of_number.h"

#include <algorithm>
#include <cmath>

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
  throw SceneMistake("tolerance", "the tolerance is " + text_of(tolerance) +
                                      "; it must lie between " + range.words);
}

void check_frequencies(const std::vector<double>& f) {
  if (f.empty()) throw SceneMistake("analysis", "a harmonic analysis needs frequencies");
  for (std::size_t i = 0; i < f.size(); ++i) {
    if (f[i] > (i == 0 ? 0.0 : f[i - 1]) && std::isfinite(f[i])) continue;
    throw SceneMistake("analysis.frequencies",
                       "frequencies must be positive and ascend strictly; number " +
                           std::to_string(i + 1) + " is " + text_of(f[i]) + " Hz");
  }
}

void check_outputs(double end_time_s, int outputs) {
  if (!(end_time_s > 0.0) || !std::isfinite(end_time_s)) {
    throw SceneMistake("analysis", "a transient analysis needs an end_time that is positive");
  }
  if (outputs >= 10 && outputs <= 200000) return;
  throw SceneMistake("analysis.outputs", "there are " + std::to_string(outputs) +
                                             " outputs; there must be between 10 and 200000");
}

}  // namespace viscard
