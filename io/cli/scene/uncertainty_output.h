#pragma once

#include "io/flow/scenes/scene_uncertainty.h"

#include <ostream>
#include <string>

namespace viscard {

// How the uncertainty of an answer is printed and stored.

// Interval of each result and its causes, the largest first.
void print_uncertainty(const SceneUncertainty& uncertainty, std::ostream& out);

// uncertainty.csv, one line for each result and input, and uncertainty.svg, the shares as bars.
void write_uncertainty(const SceneUncertainty& uncertainty, const std::string& folder,
                       const std::string& command, bool overwrite);

}  // namespace viscard
