#pragma once

#include "models/answer/scene_answer.h"

#include <string>
#include <vector>

namespace viscard {

// Removes the results that are not wanted, unless the list is empty. A wanted name also stands for
// the same name with a pillar's number, and the name of a curve for the results from it.
void keep_wanted(const std::vector<std::string>& wanted, SceneAnswer& answer);

}  // namespace viscard
