#pragma once

#include "io/materials/material_json.h"
#include "models/material/scatter.h"

#include <vector>

namespace viscard {

// {"ln_E0": {"mean", "own_error", "touch": {...}, "specimen": {...}, "ratio": {...}}, "sum_g": ...}.
// A level has "deviation", "interval_95" and "degrees_of_freedom"; one that the records cannot
// identify has null for the first two and says why in "note".
Json json_from(const std::vector<Scatter>& scatter);

void read_scatter(const Json& json, std::vector<Scatter>& scatter);

}  // namespace viscard
