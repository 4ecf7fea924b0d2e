#pragma once

#include "io/cli/scene/answer_pictures.h"
#include "models/answer/scene_answer.h"

#include <string>

namespace viscard {

// Maps over arrays in the plane as files.

// pillars.csv (places, loads, values and errors) and NAME.npy of each map: rows x columns, NaN where no
// pillar has a value. Throws std::runtime_error if a file exists and may not be overwritten.
void write_maps(const SceneAnswer& answer, const std::string& folder, const std::string& command,
                bool overwrite);

Pictures pictures_of_maps(const SceneAnswer& answer);

}  // namespace viscard
