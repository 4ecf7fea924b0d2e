#pragma once

#include "models/scene/simulate.h"

#include <functional>

namespace viscard {

// How a scene is answered: simulate(), or what stands for it near a scene that is solved already.
using SceneSolver = std::function<SceneAnswer(const Scene&)>;

}  // namespace viscard
