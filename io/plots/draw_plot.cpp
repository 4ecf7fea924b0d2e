#include "io/basics/words.h"
#include "io/plots/plot.h"
#include "io/plots/plot_points.h"
#include "io/plots/plot_script.h"
#include "io/plots/plot_svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace viscard {
namespace {

void validate(const Plot& plot, const std::string& id) {
  const auto is_plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-';
  };
  if (id.empty() || !std::all_of(id.begin(), id.end(), is_plain)) {
    throw std::invalid_argument(
        fmt::format("plot: '{}' cannot be an id; use letters, digits and '-'", id));
  }
  for (const PlotPanel& panel : plot.panels) {
    for (const PlotSeries& series : panel.series) validate(series);
    if (!has_something_to_draw(panel)) {
      throw std::invalid_argument(fmt::format(
          "plot '{}': there is nothing to draw in the panel over '{}'; give it a finite value "
          "(above zero on a logarithmic axis)",
          plot.title, panel.x.label));
    }
  }
}

}  // namespace

bool has_something_to_draw(const PlotPanel& panel) {
  const PanelSpans spans = panel_spans(panel);
  return std::any_of(panel.series.begin(), panel.series.end(), [&](const PlotSeries& series) {
    return !visible_points(series, spans.x, spans.y, 1000, 1000).empty();
  });
}

bool has_powers_of_ten(const Plot& plot) {
  constexpr double kLeast = 1e-3, kMost = 2e4;
  const auto goes_beyond = [](const AxisSpan& span) {
    return span.is_log && (span.low < kLeast || span.high > kMost);
  };
  return std::any_of(plot.panels.begin(), plot.panels.end(), [&](const PlotPanel& panel) {
    const PanelSpans spans = panel_spans(panel);
    return goes_beyond(spans.x) || goes_beyond(spans.y);
  });
}

std::string number_on_axes(const Plot& plot, double value) {
  if (!has_powers_of_ten(plot) || !(value > 0.0)) return fmt::format("{:g}", value);
  const std::string text = fmt::format("{:.5e}", value);  // "2.00000e-03"
  const int exponent = std::stoi(text.substr(text.find('e') + 1));
  const std::string power = "10" + superscript(exponent);
  const std::string digits = fmt::format("{:g}", value / std::pow(10.0, exponent));
  return digits == "1" ? power : digits + "×" + power;
}

std::string svg_from_plot(const Plot& plot, const std::string& id) {
  validate(plot, id);
  return figure_from_gnuplot_svg(run_gnuplot(gnuplot_script(plot)), id, plot.title,
                                 plot.description, plot.width_px, plot.height_px);
}

}  // namespace viscard
