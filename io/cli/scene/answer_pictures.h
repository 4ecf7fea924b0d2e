#pragma once

#include "models/scene/common/scene_answer.h"

#include <string>
#include <utility>
#include <vector>

namespace viscard {

// Pictures of a scene's curves, name and SVG: histories over time, responses over frequency
// (magnitude on logarithmic axes above phase), spectra. Empty where gnuplot is not installed: the
// numbers are in the CSV files all the same.
std::vector<std::pair<std::string, std::string>> pictures_of(const SceneAnswer& answer);

// True when the largest size is over 30 times the smallest that is not zero: a logarithmic axis.
bool spans_decades(const std::vector<double>& values);

}  // namespace viscard
