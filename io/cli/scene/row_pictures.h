#pragma once

#include "io/cli/scene/array_sweep.h"
#include "models/scene/common/scene_answer.h"

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace viscard {

// Pictures of rows of pillars, name and SVG. Empty where gnuplot is not installed: the numbers are
// in the tables all the same.

// A result that every pillar has ("centre_voltage_1", "centre_voltage_2", ...) over the pillars'
// numbers, with its error; its size on a logarithmic axis where the pillars differ by decades.
std::vector<std::pair<std::string, std::string>> pictures_over_pillars(const SceneAnswer& answer);

// Each result of a sweep over the parameter with the most values, one line for each combination of
// the others; the limit on the deviation is drawn if the sweep has one.
std::vector<std::pair<std::string, std::string>> pictures_over_sweep(
    const ArraySweep& sweep, const std::vector<SweepPoint>& points,
    const std::map<std::size_t, SweepRow>& rows);

}  // namespace viscard
