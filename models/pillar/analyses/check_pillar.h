#pragma once

#include "models/pillar/scene/pillar_scene.h"

namespace viscard {

// Throws std::invalid_argument, mostly SceneMistake, naming what is missing or contradictory.
void validate(const PillarScene& scene);

}  // namespace viscard
