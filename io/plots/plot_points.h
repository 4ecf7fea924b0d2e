#pragma once

#include "io/plots/plot.h"
#include "io/plots/plot_axis.h"

#include <vector>

namespace viscard {

struct PlotPoint {
  double x = 0.0, y = 0.0;
  double x_low = 0.0, x_high = 0.0;  // kErrorBars
  double y_low = 0.0, y_high = 0.0;  // kErrorBars and kBand
  bool breaks_before = false;        // a line or band starts anew here
};

// Throws std::invalid_argument naming the series when its columns differ in length.
void validate(const PlotSeries& series);

// The points of a series that its axes can show, thinned to what `width_px` by `height_px` pixels
// can tell apart: a line keeps first, lowest, highest and last point of each pixel column, a band
// its outline, dots one per cell of kDotCell_px. Error bars are never thinned; a bar that leaves a
// logarithmic axis ends at its lower end.
std::vector<PlotPoint> visible_points(const PlotSeries& series, const AxisRange& x,
                                      const AxisRange& y, int width_px, int height_px);

inline constexpr double kDotCell_px = 2.0;

}  // namespace viscard
