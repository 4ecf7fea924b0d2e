#include "io/report/report_figures.h"
#include "io/report/report_numbers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace viscard {
namespace {

// A motion with the hold after it: samples first .. last - 1, time counted from start_s.
struct Motion {
  double start_s = 0.0;
  std::size_t first = 0, last = 0;
};

std::vector<Motion> motions_of(const FitCurves& curves) {
  std::vector<double> starts = curves.motion_start_s;
  if (starts.empty()) starts.push_back(0.0);
  std::vector<Motion> motions;
  for (std::size_t k = 0; k < starts.size(); ++k) {
    const auto index_at = [&](double time_s) {
      return static_cast<std::size_t>(
          std::lower_bound(curves.time_s.begin(), curves.time_s.end(), time_s) -
          curves.time_s.begin());
    };
    const std::size_t last = k + 1 < starts.size() ? index_at(starts[k + 1]) : curves.time_s.size();
    const Motion motion{starts[k], k == 0 ? 0 : index_at(starts[k]), last};
    if (motion.last > motion.first + 2) motions.push_back(motion);
  }
  return motions;
}

struct FitColumns {
  PlotSeries measured, fitted, residual;
};

FitColumns columns_of(const FitCurves& curves, const Motion& motion, double factor) {
  FitColumns columns;
  columns.measured = {.mark = Mark::kPoints, .label = "measured", .ink = Ink::kGrey, .size = 1.1};
  columns.fitted = {.mark = Mark::kLine, .label = "fit", .ink = Ink::kVermillion, .size = 0.9};
  columns.residual = {.mark = Mark::kPoints, .ink = Ink::kBlue, .size = 0.9};
  const bool has_sigma = curves.sigma.size() == curves.time_s.size();
  for (std::size_t i = motion.first; i < motion.last; ++i) {
    const double time_s = curves.time_s[i] - motion.start_s;
    columns.measured.x.push_back(time_s);
    columns.fitted.x.push_back(time_s);
    columns.residual.x.push_back(time_s);
    columns.measured.y.push_back(curves.measured[i] * factor);
    columns.fitted.y.push_back(curves.fitted[i] * factor);
    const double residual = curves.measured[i] - curves.fitted[i];
    const double scale = has_sigma && curves.sigma[i] > 0.0 ? 1.0 / curves.sigma[i] : factor;
    columns.residual.y.push_back(residual * scale);
  }
  return columns;
}

// The force changes during a hold by a few per cent of its change during the motion before it.
// Limits the axis to the values after the extreme of the motion, so that the hold is visible.
void show_the_hold(PlotAxis& axis, const PlotSeries& fitted) {
  const auto [lowest, highest] = std::minmax_element(fitted.y.begin(), fitted.y.end());
  const bool is_loading = fitted.y.front() < fitted.y.back();
  const auto extreme = is_loading ? highest : lowest;
  if (extreme == fitted.y.begin() || extreme + 2 >= fitted.y.end()) return;
  const auto [low, high] = std::minmax_element(extreme, fitted.y.end());
  const double span = *high - *low;
  if (!(span > 0.0) || span > 0.5 * (*highest - *lowest)) return;
  axis.min = *low - (is_loading ? 0.35 : 0.15) * span;
  axis.max = *high + (is_loading ? 0.15 : 0.35) * span;
}

const char* motion_name(std::size_t index, std::size_t n_motions) {
  if (n_motions == 1) return "";
  constexpr const char* kNames[] = {"Loading and hold", "Unloading and recovery"};
  return index < 2 ? kNames[index] : "Next motion";
}

const char* value_name(const FitResult& fit) {
  // Creep under a stress that changes has no compliance in each row.
  if (fit.kind == FitKind::kCreep && fit.curves.unit.empty()) return "strain";
  constexpr const char* kNames[] = {"force", "relaxation modulus", "creep compliance",
                                    "storage modulus", "value"};
  return kNames[static_cast<std::size_t>(fit.kind)];
}

// Flagged readings may be far outside of the others, which would then fill a small part of the
// axis; they are drawn at the edge.
PlotSeries flagged_dots(const RunSeries& series, double per_si) {
  const auto [lowest, highest] = std::minmax_element(series.volts.begin(), series.volts.end());
  PlotSeries dots{.mark = Mark::kPoints, .label = "saturated or glitch, left out"};
  dots.ink = Ink::kVermillion;
  dots.size = 2.0;
  dots.x = series.flagged_s;
  for (const double volts : series.flagged_V) {
    dots.y.push_back(per_si * std::clamp(volts, *lowest, *highest));
  }
  return dots;
}

}  // namespace

std::optional<Plot> run_plot(const RunSeries& series) {
  if (series.time_s.empty()) return std::nullopt;
  const ShownUnit volt = shown_unit(series.is_force ? "N" : "V", series.volts);
  PlotPanel volts;
  volts.y.label = fmt::format("{} ({})", series.is_force ? "force gauge" : "amplifier", volt.text);
  volts.x.label = "time since the run began (s)";
  volts.notes = series.phases;
  volts.height_share = 1.2;
  volts.series.push_back({.x = series.time_s, .y = scaled(series.volts, volt.per_si), .size = 0.7});
  if (!series.flagged_s.empty()) volts.series.push_back(flagged_dots(series, volt.per_si));
  Plot plot{.title = "Recorded run",
            .description = "Output of the load cell and position of the stage over time.",
            .height_px = 430};
  PlotPanel way;
  way.x.label = volts.x.label;
  way.series.push_back({.ink = Ink::kGreen, .size = 0.8});
  if (!series.depth_m.empty()) {
    const double deepest = *std::max_element(series.depth_m.begin(), series.depth_m.end());
    const ShownUnit unit = shown_unit("m", {deepest});
    way.y.label = fmt::format("depth ({})", unit.text);
    way.y.min =
        -0.5 * deepest * unit.per_si;  // leaves out most of the approach, which is much longer
    way.series[0].x = series.time_s;
    way.series[0].y = scaled(series.depth_m, unit.per_si);
  } else if (!series.report_s.empty()) {
    const ShownUnit unit = shown_unit("m", series.position_m);
    way.y.label = fmt::format("stage ({})", unit.text);
    way.series[0].x = series.report_s;
    way.series[0].y = scaled(series.position_m, unit.per_si);
  }
  const bool has_way = has_something_to_draw(way);
  volts.shares_x_with_below = has_way;
  if (has_way) {
    volts.x.min = way.x.min = series.time_s.front();
    volts.x.max = way.x.max = series.time_s.back();
    for (const PlotNote& note : series.phases) way.notes.push_back({note.x, ""});
  }
  plot.panels.push_back(volts);
  if (has_way) plot.panels.push_back(way);
  return plot;
}

void show_two_sigma(PlotPanel& panel) {
  double largest = 3.0, first = INFINITY, last = -INFINITY;
  for (const PlotSeries& residual : panel.series) {
    for (const double value : residual.y) {
      if (std::isfinite(value)) largest = std::max(largest, std::abs(value));
    }
    // The band begins at the first time that the axis can show.
    for (const double at : residual.x) {
      if (panel.x.is_log && !(at > 0.0)) continue;
      first = std::min(first, at);
      last = std::max(last, at);
    }
  }
  panel.y.max = 1.1 * largest;
  panel.y.min = -1.1 * largest;
  if (!(last > first)) return;
  PlotSeries band{.mark = Mark::kBand, .ink = Ink::kGrey};
  band.x = {first, last};
  band.y_low = {-1.96, -1.96};
  band.y_high = {1.96, 1.96};
  panel.series.insert(panel.series.begin(), band);
}

std::optional<Plot> fit_plot(const FitResult& fit, bool is_master) {
  if (auto oscillation = oscillation_plot(fit, is_master)) return oscillation;
  const FitCurves& curves = fit.curves;
  const std::vector<Motion> motions = motions_of(curves);
  if (motions.empty()) return std::nullopt;
  const bool is_dma = fit.kind == FitKind::kDma;
  const ShownUnit unit = shown_unit(curves.unit, curves.measured);
  Plot plot{.title = "Data and fit",
            .description =
                "Measured and fitted values over the logarithm of time, and their difference over "
                "the logarithm of time and in time order.",
            .columns = static_cast<int>(motions.size()),
            .height_px = 660};
  std::vector<PlotPanel> residuals, in_order;
  for (std::size_t k = 0; k < motions.size(); ++k) {
    FitColumns columns = columns_of(curves, motions[k], unit.per_si);
    PlotPanel values;
    values.title = motion_name(k, motions.size());
    values.x.is_log = true;
    values.x.label = is_dma      ? "frequency (Hz)"
                     : is_master ? "reduced time t/aT (s)"
                     : k == 0    ? "time (s)"
                                 : "time since unloading (s)";
    values.y.label =
        unit.text.empty() ? value_name(fit) : fmt::format("{} ({})", value_name(fit), unit.text);
    values.height_share = 2.0;
    values.shares_x_with_below = true;
    if (fit.kind == FitKind::kIndentation) show_the_hold(values.y, columns.fitted);
    PlotPanel residual;
    residual.x = values.x;
    const bool has_sigma = curves.sigma.size() == curves.time_s.size();
    residual.y.label = has_sigma ? "residual/σ" : fmt::format("residual ({})", unit.text);
    residual.height_share = 1.1;
    values.series = {columns.measured, columns.fitted};
    residual.series = {columns.residual};
    PlotPanel ordered = residual;
    ordered.x.is_log = false;
    ordered.x.label = values.x.label + ", in time order";
    for (PlotPanel* panel : {&residual, &ordered}) {
      if (has_sigma) show_two_sigma(*panel);
    }
    plot.panels.push_back(values);
    residuals.push_back(residual);
    in_order.push_back(ordered);
  }
  plot.panels.insert(plot.panels.end(), residuals.begin(), residuals.end());
  plot.panels.insert(plot.panels.end(), in_order.begin(), in_order.end());
  for (const PlotPanel& panel : plot.panels) {
    if (!has_something_to_draw(panel)) return std::nullopt;
  }
  return plot;
}

}  // namespace viscard
