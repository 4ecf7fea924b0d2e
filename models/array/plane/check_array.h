#pragma once

#include "models/array/plane/array_scene.h"

#include <string>
#include <vector>

namespace viscard {

// Throws SceneMistake naming what is missing or contradictory.
void validate(const ArrayScene& scene);

// What the checks of loaded rows share. Throw SceneMistake: for a pressure beyond buckling, under
// `key`; for a load that is zero or beyond buckling.
void check_pressure(const ArrayScene& scene, double pressure_Pa, const char* key);
void check_load(const ArrayScene& scene);

// What a scene may ask for, without the pillars' numbers (simulate_array.h).
std::vector<std::string> result_names(const ArrayScene& scene);

}  // namespace viscard
