#pragma once

#include "io/materials/material_json.h"
#include "models/material/scatter.h"

#include <vector>

namespace viscard {

class ResultVisitor;

// The key "scatter": an object for each quantity. A level that the records cannot identify has null for
// its deviation and says why in "note".
void show_scatter(ResultVisitor& v, const std::vector<Scatter>& scatter);

void read_scatter(const Json& json, std::vector<Scatter>& scatter);

}  // namespace viscard
