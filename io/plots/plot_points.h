#pragma once

#include "io/plots/plot.h"

#include <vector>

namespace viscard {

// The part of an axis that the data need, low < high; both positive on a logarithmic axis, where it
// includes a margin: 4 % of the length, or whole decades if fewer than two powers of ten are in the
// range. An end that the axis gives replaces that of the data.
struct AxisSpan {
  double low = 0.0;
  double high = 1.0;
  bool is_log = false;
};

// Values that the axis cannot show are ignored; without any other the span is [0, 1] or [1, 10].
AxisSpan axis_span(const PlotAxis& axis, const std::vector<double>& values);

struct PanelSpans {
  AxisSpan x, y;
};
PanelSpans panel_spans(const PlotPanel& panel);

// True if the value is finite, and positive for a logarithmic axis.
bool can_show(const AxisSpan& span, double value);

// 0 at low, 1 at high; not finite where the axis cannot show the value.
double fraction_of(const AxisSpan& span, double value);

struct PlotPoint {
  double x = 0.0, y = 0.0;
  double x_low = 0.0, x_high = 0.0;  // kErrorBars
  double y_low = 0.0, y_high = 0.0;  // kErrorBars and kBand
  bool breaks_before = false;        // a line or band starts anew here
};

// Throws std::invalid_argument naming the series when its columns differ in length.
void validate(const PlotSeries& series);

// The points of a series that its axes can show, reduced to those that differ in a picture of
// `width_px` by `height_px` pixels: a line keeps the first, lowest, highest and last point of each
// pixel column, a band its outline, dots one per cell of kDotCell_px. gnuplot would write all of
// hundreds of thousands of points into the page. Error bars are never reduced; a bar that reaches
// zero on a logarithmic axis ends at the lower end of the axis.
std::vector<PlotPoint> visible_points(const PlotSeries& series, const AxisSpan& x,
                                      const AxisSpan& y, int width_px, int height_px);

inline constexpr double kDotCell_px = 2.0;

}  // namespace viscard
