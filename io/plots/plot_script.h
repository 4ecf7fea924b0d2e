#pragma once

#include "io/plots/plot_data.h"

#include <string>

namespace viscard {

// The gnuplot commands and data that draw the plot as SVG. gnuplot chooses ranges, ticks, margins
// and the place of the legend. Throws std::invalid_argument if the plot has no panel or the panels
// would be smaller than kLeastPanelWidth_px by kLeastPanelHeight_px.
std::string gnuplot_script(const Plot& plot);

inline constexpr double kLeastPanelWidth_px = 130.0;
inline constexpr double kLeastPanelHeight_px = 80.0;

}  // namespace viscard
