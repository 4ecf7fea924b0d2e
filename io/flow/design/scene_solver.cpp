#include "io/flow/design/scene_solver.h"

#include <algorithm>

namespace viscard {

const SceneResult* result_in(const SceneAnswer& answer, const std::string& name) {
  const auto found = std::find_if(answer.results.begin(), answer.results.end(),
                                  [&](const SceneResult& one) { return one.name == name; });
  return found == answer.results.end() ? nullptr : &*found;
}

const SceneCurve* curve_in(const SceneAnswer& answer, const std::string& name) {
  const auto found = std::find_if(answer.curves.begin(), answer.curves.end(),
                                  [&](const SceneCurve& one) { return one.name == name; });
  return found == answer.curves.end() ? nullptr : &*found;
}

}  // namespace viscard
