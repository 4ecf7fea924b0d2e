#include "io/plots/plot_points.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <unordered_set>

namespace viscard {
namespace {

bool can_show(const AxisRange& range, double value) {
  return std::isfinite(value) && !(range.is_log && value <= 0.0);
}

// End of an error bar: on a logarithmic axis one that reaches zero is cut at the axis.
double bar_end(const AxisRange& range, double value) {
  return range.is_log && !(value > range.min) ? range.min : value;
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

std::vector<PlotPoint> showable_points(const PlotSeries& series, const AxisRange& x,
                                       const AxisRange& y) {
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

std::vector<PlotPoint> thinned_dots(const std::vector<PlotPoint>& points, const AxisRange& x,
                                    const AxisRange& y, int width_px, int height_px) {
  std::unordered_set<std::int64_t> taken;
  std::vector<PlotPoint> kept;
  for (const PlotPoint& point : points) {
    const std::int64_t column = cell(axis_fraction(x, point.x), width_px, kDotCell_px);
    const std::int64_t row = cell(axis_fraction(y, point.y), height_px, kDotCell_px);
    if (taken.insert(column * 100000 + row).second) kept.push_back(point);
  }
  return kept;
}

// Points first..last of one pixel column, boiled down.
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

std::vector<PlotPoint> thinned_columns(const std::vector<PlotPoint>& points, const AxisRange& x,
                                       int width_px, bool is_band) {
  std::vector<PlotPoint> kept;
  for (std::size_t first = 0; first < points.size();) {
    const std::int64_t column = cell(axis_fraction(x, points[first].x), width_px, 1.0);
    std::size_t last = first;
    while (last + 1 < points.size() && !points[last + 1].breaks_before &&
           cell(axis_fraction(x, points[last + 1].x), width_px, 1.0) == column) {
      ++last;
    }
    is_band ? keep_outline(points, first, last, kept) : keep_extremes(points, first, last, kept);
    first = last + 1;
  }
  return kept;
}

}  // namespace

void validate(const PlotSeries& series) {
  const std::size_t n = series.x.size();
  const bool needs_bars = series.mark == Mark::kBand || series.mark == Mark::kErrorBars;
  const bool fits = (series.mark == Mark::kBand || series.y.size() == n) &&
                    (!needs_bars || (series.y_low.size() == n && series.y_high.size() == n)) &&
                    (series.x_low.size() == series.x_high.size()) &&
                    (series.x_low.empty() || series.x_low.size() == n);
  if (!fits) {
    throw std::invalid_argument("plot: the columns of series '" + series.label +
                                "' differ in length");
  }
}

std::vector<PlotPoint> visible_points(const PlotSeries& series, const AxisRange& x,
                                      const AxisRange& y, int width_px, int height_px) {
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
