#pragma once

#include "models/pillar/scene/pillar_scene.h"

#include <string>

namespace viscard {

// svg_from_scene() of one pillar.
std::string svg_from_pillar(const PillarScene& scene, const std::string& title);

}  // namespace viscard
