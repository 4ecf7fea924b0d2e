#pragma once

#include "io/plots/plot.h"

#include <string>

namespace viscard {

// The gnuplot commands and data that draw the plot as SVG. gnuplot chooses ranges, ticks, margins
// and the place of the legend. Throws std::invalid_argument if the plot has no panel or the panels
// would be smaller than kLeastPanelWidth_px by kLeastPanelHeight_px.
std::string gnuplot_script(const Plot& plot);

inline constexpr double kLeastPanelWidth_px = 130.0;
inline constexpr double kLeastPanelHeight_px = 80.0;

// Runs gnuplot on a script, without the user's own settings, and returns what it wrote to standard
// output. Script, output and messages stay in memory: no file is made and none can be left behind.
// Throws std::runtime_error when gnuplot is not installed (saying how to), cannot be started, or
// ends with an error (its first message).
std::string run_gnuplot(const std::string& script);

}  // namespace viscard
