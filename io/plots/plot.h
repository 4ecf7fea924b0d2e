#pragma once

#include "io/plots/plot_data.h"

#include <string>

namespace viscard {

// Draws the picture with gnuplot and returns a complete <svg> element without XML declaration, to
// be put into a page or a file. Every id in it begins with `id` (letters, digits, '-'), so that
// several figures can share a page. Series with more points than pixels are reduced first: a line
// to the extremes within each pixel column, dots to one per cell of the picture. The same plot
// gives the same bytes. Throws std::invalid_argument if the id has other characters, the columns of
// a series differ in length, a panel has no value that its axes can show, or the panels do not fit
// into the picture; std::runtime_error if gnuplot is not installed or fails, with its message.
std::string svg_from_plot(const Plot& plot, const std::string& id);

// True if some series of the panel has a point that its axes can show.
bool has_something_to_draw(const PlotPanel& panel);

}  // namespace viscard
