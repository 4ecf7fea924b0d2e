#include "io/plots/plot_points.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <unordered_set>
#include <utility>

namespace viscard {
namespace {

std::vector<double> values_along(const PlotPanel& panel, bool is_x) {
  std::vector<double> values;
  const auto add = [&](const std::vector<double>& more) {
    values.insert(values.end(), more.begin(), more.end());
  };
  for (const PlotSeries& series : panel.series) {
    add(is_x ? series.x : series.y);
    add(is_x ? series.x_low : series.y_low);
    add(is_x ? series.x_high : series.y_high);
  }
  return values;
}

double power_of_ten(double exponent) {
  return std::max(std::pow(10.0, exponent), std::numeric_limits<double>::min());
}

// gnuplot extends a logarithmic axis to whole decades, which can leave most of it empty, and labels
// powers of ten only. So the axis gets a margin of 4 % if two powers of ten remain on it.
void add_log_margin(AxisSpan& span) {
  const double margin = std::pow(span.high / span.low, 0.04);
  const double low = span.low / margin, high = span.high * margin;
  if (std::floor(std::log10(high)) - std::ceil(std::log10(low)) >= 1.0) {
    span.low = low;
    span.high = high;
    return;
  }
  span.low = power_of_ten(std::floor(std::log10(span.low)));
  span.high = power_of_ten(std::ceil(std::log10(span.high)));
  if (!(span.high > span.low)) span.high = 10.0 * span.low;
}

// gnuplot would leave out a bar that reaches zero on a logarithmic axis.
double bar_end(const AxisSpan& span, double value) {
  return span.is_log && !(value > span.low) ? span.low : value;
}

PlotPoint point_at(const PlotSeries& series, std::size_t i) {
  PlotPoint point;
  point.x = point.x_low = point.x_high = series.x[i];
  if (!series.y.empty()) point.y = point.y_low = point.y_high = series.y[i];
  if (!series.y_low.empty()) {
    point.y_low = series.y_low[i];
    point.y_high = series.y_high[i];
  }
  if (!series.x_low.empty()) {
    point.x_low = series.x_low[i];
    point.x_high = series.x_high[i];
  }
  return point;
}

std::vector<PlotPoint> showable_points(const PlotSeries& series, const AxisSpan& x,
                                       const AxisSpan& y) {
  std::vector<PlotPoint> points;
  bool breaks = false;
  for (std::size_t i = 0; i < series.x.size(); ++i) {
    PlotPoint point = point_at(series, i);
    if (series.mark == Mark::kErrorBars || series.mark == Mark::kBand) {
      point.x_low = bar_end(x, point.x_low);
      point.y_low = bar_end(y, point.y_low);
    }
    const bool is_shown = can_show(x, point.x) && can_show(x, point.x_low) &&
                          can_show(x, point.x_high) && can_show(y, point.y_low) &&
                          can_show(y, point.y_high) &&
                          (series.mark == Mark::kBand || can_show(y, point.y));
    if (!is_shown) {
      breaks = true;
      continue;
    }
    point.breaks_before = breaks && !points.empty();
    breaks = false;
    points.push_back(point);
  }
  return points;
}

std::int64_t cell(double fraction, double length_px, double cell_px) {
  const double inside = std::clamp(fraction, -1.0, 2.0);
  return static_cast<std::int64_t>(std::floor(inside * length_px / cell_px));
}

std::vector<PlotPoint> thinned_dots(const std::vector<PlotPoint>& points, const AxisSpan& x,
                                    const AxisSpan& y, int width_px, int height_px) {
  std::unordered_set<std::int64_t> taken;
  std::vector<PlotPoint> kept;
  for (const PlotPoint& point : points) {
    const std::int64_t column = cell(fraction_of(x, point.x), width_px, kDotCell_px);
    const std::int64_t row = cell(fraction_of(y, point.y), height_px, kDotCell_px);
    if (taken.insert(column * 100000 + row).second) kept.push_back(point);
  }
  return kept;
}

// Keeps the first, lowest, highest and last of the points first..last of one pixel column.
void keep_extremes(const std::vector<PlotPoint>& points, std::size_t first, std::size_t last,
                   std::vector<PlotPoint>& kept) {
  std::size_t lowest = first, highest = first;
  for (std::size_t i = first; i <= last; ++i) {
    if (points[i].y < points[lowest].y) lowest = i;
    if (points[i].y > points[highest].y) highest = i;
  }
  std::size_t picks[] = {first, lowest, highest, last};
  std::sort(std::begin(picks), std::end(picks));
  const auto* end = std::unique(std::begin(picks), std::end(picks));
  for (const auto* pick = std::begin(picks); pick != end; ++pick) kept.push_back(points[*pick]);
}

void keep_outline(const std::vector<PlotPoint>& points, std::size_t first, std::size_t last,
                  std::vector<PlotPoint>& kept) {
  PlotPoint widest = points[first];
  for (std::size_t i = first; i <= last; ++i) {
    widest.y_low = std::min(widest.y_low, points[i].y_low);
    widest.y_high = std::max(widest.y_high, points[i].y_high);
  }
  kept.push_back(widest);
  if (last > first) {
    widest.x = points[last].x;
    widest.breaks_before = false;
    kept.push_back(widest);
  }
}

std::vector<PlotPoint> thinned_columns(const std::vector<PlotPoint>& points, const AxisSpan& x,
                                       int width_px, bool is_band) {
  std::vector<PlotPoint> kept;
  for (std::size_t first = 0; first < points.size();) {
    const std::int64_t column = cell(fraction_of(x, points[first].x), width_px, 1.0);
    std::size_t last = first;
    while (last + 1 < points.size() && !points[last + 1].breaks_before &&
           cell(fraction_of(x, points[last + 1].x), width_px, 1.0) == column) {
      ++last;
    }
    is_band ? keep_outline(points, first, last, kept) : keep_extremes(points, first, last, kept);
    first = last + 1;
  }
  return kept;
}

}  // namespace

AxisSpan axis_span(const PlotAxis& axis, const std::vector<double>& values) {
  AxisSpan span{std::numeric_limits<double>::infinity(), 0.0, axis.is_log};
  span.high = -span.low;
  for (const double value : values) {
    if (!can_show(span, value)) continue;
    span.low = std::min(span.low, value);
    span.high = std::max(span.high, value);
  }
  if (span.low > span.high) {
    span.low = axis.is_log ? 1.0 : 0.0;
    span.high = axis.is_log ? 10.0 : 1.0;
  }
  if (span.is_log) add_log_margin(span);
  if (axis.min && can_show(span, *axis.min)) span.low = *axis.min;
  if (axis.max && can_show(span, *axis.max)) span.high = *axis.max;
  if (span.low > span.high) std::swap(span.low, span.high);
  if (span.low == span.high) {
    const double half = span.low == 0.0 ? 1.0 : 0.05 * std::abs(span.low);
    span.low -= half;
    span.high += half;
  }
  return span;
}

PanelSpans panel_spans(const PlotPanel& panel) {
  return {axis_span(panel.x, values_along(panel, true)),
          axis_span(panel.y, values_along(panel, false))};
}

bool can_show(const AxisSpan& span, double value) {
  return std::isfinite(value) && !(span.is_log && value <= 0.0);
}

double fraction_of(const AxisSpan& span, double value) {
  if (!span.is_log) return (value - span.low) / (span.high - span.low);
  if (!(value > 0.0)) return std::numeric_limits<double>::quiet_NaN();
  return std::log(value / span.low) / std::log(span.high / span.low);
}

void validate(const PlotSeries& series) {
  const std::size_t n = series.x.size();
  const bool needs_bars = series.mark == Mark::kBand || series.mark == Mark::kErrorBars;
  const bool fits = (series.mark == Mark::kBand || series.y.size() == n) &&
                    (!needs_bars || (series.y_low.size() == n && series.y_high.size() == n)) &&
                    (series.x_low.size() == series.x_high.size()) &&
                    (series.x_low.empty() || series.x_low.size() == n) &&
                    (series.names.empty() || series.names.size() == n);
  if (!fits) {
    throw std::invalid_argument("plot: the columns of series '" + series.label +
                                "' differ in length; give every point all its values");
  }
}

std::vector<PlotPoint> visible_points(const PlotSeries& series, const AxisSpan& x,
                                      const AxisSpan& y, int width_px, int height_px) {
  std::vector<PlotPoint> points = showable_points(series, x, y);
  switch (series.mark) {
    case Mark::kErrorBars:
      return points;
    case Mark::kPoints:
      return thinned_dots(points, x, y, width_px, height_px);
    case Mark::kLine:
    case Mark::kBand:
      break;
  }
  if (points.size() <= 2 * static_cast<std::size_t>(width_px)) return points;
  return thinned_columns(points, x, width_px, series.mark == Mark::kBand);
}

}  // namespace viscard
