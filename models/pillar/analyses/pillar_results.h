#pragma once

#include "models/pillar/scene/pillar_scene.h"

#include <string>
#include <vector>

namespace viscard {

// Everything a scene may ask for under [want]: the names of its results, and of its curves, which
// stand for the results read off them. Nothing is solved. tests/models/scene compares this list
// with what the analyses give.
std::vector<std::string> result_names(const PillarScene& scene);

// Names of what moves in time or frequency, each followed by the same with every ending: the top's
// (`first`), then what the film shows of it.
std::vector<std::string> moving_names(const PillarScene& scene, const std::string& first,
                                      const std::vector<std::string>& endings);

}  // namespace viscard
