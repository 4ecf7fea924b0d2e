#pragma once

#include "models/scene/simulate.h"

#include <functional>
#include <string>

namespace viscard {

// How a scene is answered: simulate(), or what stands for it near a scene that is solved already.
using SceneSolver = std::function<SceneAnswer(const Scene&)>;

// What an answer has under a name; null: nothing.
const SceneResult* result_in(const SceneAnswer& answer, const std::string& name);
const SceneCurve* curve_in(const SceneAnswer& answer, const std::string& name);
// They would point into an answer that is gone.
const SceneResult* result_in(SceneAnswer&&, const std::string&) = delete;
const SceneCurve* curve_in(SceneAnswer&&, const std::string&) = delete;

}  // namespace viscard
