#pragma once

// The value, result or curve of an answer with this name. Throws std::runtime_error if there is none.
#include "models/answer/scene_answer.h"

#include <stdexcept>
#include <string>

namespace viscard::test {

inline const SceneCurve& curve_of(const SceneAnswer& answer, const std::string& name) {
  for (const SceneCurve& curve : answer.curves) {
    if (curve.name == name) return curve;
  }
  throw std::runtime_error("no curve " + name);
}

inline const SceneResult& result_of(const SceneAnswer& answer, const std::string& name) {
  for (const SceneResult& result : answer.results) {
    if (result.name == name) return result;
  }
  throw std::runtime_error("no result " + name);
}

inline double value_of(const SceneAnswer& answer, const std::string& name) {
  return result_of(answer, name).value;
}

}  // namespace viscard::test
