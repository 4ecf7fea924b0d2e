#pragma once

#include "io/plots/plot_points.h"

#include <cstddef>
#include <string>

namespace viscard {

// The range of an axis in a picture and the numbers beside it, chosen here rather than by gnuplot, so
// that their length is known before the margins are.
struct AxisTicks {
  AxisSpan shown;
  double step = 0.0;           // between numbers; a logarithmic axis has powers of ten
  std::string format;          // of gnuplot
  std::size_t characters = 0;  // of the longest number
};

// About ten numbers along `length_px`, fewer where they need more room: each needs the least, and along
// the axis x (`is_along`) its own length with a gap. An end that is not given is the round number at or beyond the last value.
// `has_powers`: logarithmic axes show 10^3 rather than 1000.
AxisTicks ticks_of(const PlotAxis& axis, const AxisSpan& span, double length_px, bool is_along,
                   bool has_powers);

}  // namespace viscard
