#pragma once

#include "models/array/space/space_array.h"
#include "models/array/space/space_scene.h"
#include "models/scene/common/scene_answer.h"

#include <cstddef>
#include <string>
#include <vector>

namespace viscard {

constexpr double kCrosstalkScale = 10.0;  // %: a tolerance of 1e-3 gives per cents to 0.01 points
constexpr const char* kCrosstalk = "crosstalk_percent";

// True if the scene asks for a map, or for one of its values.
bool asks_for_map(const SpaceScene& scene, const std::string& map);
// True if there are unloaded pillars, and loaded ones have a voltage of their own to compare with.
bool has_crosstalk(const SpaceScene& scene);

// The pillars and the loads on their tops, as an answer shows them.
SceneArray array_of_answer(const SpaceScene& scene, const TopLoads& loads_Pa);

// The maps of voltages and of cross-talk that the scene asks for, without errors.
std::vector<SceneMap> maps_of(const SpaceScene& scene, const SpaceResponse& response,
                              const TopLoads& loads_Pa);

// The side of the cells of a square lattice of like pillars without gaps; 0 for other arrays.
double square_pitch_m(const SpaceScene& scene);

// Curves over the wavelength of a wave along x on an endless square lattice, if the scene asks for them by
// name (eq. S13): voltage_per_pressure (of the mean pressure on the cells) and voltage_per_height (of a
// rigid surface that touches all tops), of the disc or electrode under a pillar, with neighbours up to
// `reach_m` away.
void add_transfer(const SpaceScene& scene, const SpaceResponse& response, double reach_m,
                  SceneAnswer& answer);

// Results name single pillars where there are at most this many.
constexpr std::size_t kMostNamedPillars = 25;

// Replaces those results of the answer that are values of its maps: the largest and the smallest of
// each, and those of single pillars that the scene wants.
void set_results(const SpaceScene& scene, SceneAnswer& answer);

}  // namespace viscard
