#include "io/plots/plot.h"
#include "io/plots/plot_points.h"
#include "io/plots/plot_script.h"
#include "io/plots/plot_svg.h"

#include <fmt/format.h>

#include <algorithm>
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

std::string svg_from_plot(const Plot& plot, const std::string& id) {
  validate(plot, id);
  return figure_from_gnuplot_svg(run_gnuplot(gnuplot_script(plot)), id, plot.title,
                                 plot.description, plot.width_px, plot.height_px);
}

}  // namespace viscard
