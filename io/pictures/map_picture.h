#pragma once

#include "models/scene/common/scene_answer.h"

#include <string>

namespace viscard {

// A map over an array in the plane, from above and to scale, as an SVG document: pillars as discs up to
// 20 rows and columns, as cells beyond; loaded pillars have a dark rim, pillars without a value are
// hollow. The bar of colours has round numbers, voltages in V, mV, uV or nV.
std::string svg_from_map(const SceneArray& array, const SceneMap& map, const std::string& title);

}  // namespace viscard
