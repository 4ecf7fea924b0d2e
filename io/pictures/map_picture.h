#pragma once

#include "models/answer/scene_answer.h"

#include <string>

namespace viscard {

// A map over an array in the plane, from above and to scale, as an SVG document: pillars as discs up to
// 20 rows and columns, as cells beyond; loaded pillars have a dark rim, pillars without a value are
// hollow. The bar of colours has round numbers, voltages in V, mV, uV or nV.
std::string svg_from_map(const SceneArray& array, const SceneMap& map, const std::string& title);

// Forces in three directions in one picture: the map of the normal force, and an arrow for the shear of each pillar, whose
// length is that of the largest shear at one pitch. On arrays of more than 20 rows or columns arrows stand for blocks of
// pillars, whose mean they are. The maps have a value for each pillar.
struct ForceMaps {
  const SceneMap& normal;
  const SceneMap& along_x;
  const SceneMap& along_y;
};
std::string svg_from_forces(const SceneArray& array, const ForceMaps& forces,
                            const std::string& title);

}  // namespace viscard
