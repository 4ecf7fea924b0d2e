#pragma once

#include "io/cli/scene/answer_pictures.h"
#include "models/scene/common/scene_answer.h"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace viscard {

// Maps over arrays in the plane as JSON and files.

// [{name, unit, largest, smallest, error_estimate, values}]; values stand in the order of the pillars,
// null for a pillar without one. The error is the largest over the map.
nlohmann::json json_from_maps(const SceneAnswer& answer);
// {row, column, x_m, y_m}, a list each.
nlohmann::json json_from_pillars(const SceneArray& array);

// pillars.csv (places, loads, values and errors) and NAME.npy of each map: rows x columns, NaN where no
// pillar has a value. Throws std::runtime_error if a file exists and may not be overwritten.
void write_maps(const SceneAnswer& answer, const std::string& folder, const std::string& command,
                bool overwrite);

Pictures pictures_of_maps(const SceneAnswer& answer);

}  // namespace viscard
