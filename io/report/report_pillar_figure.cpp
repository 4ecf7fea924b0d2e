#include "io/report/report_figures.h"
#include "io/report/report_numbers.h"

#include <algorithm>
#include <cmath>

namespace viscard {
namespace {

constexpr double kRounding =
    1e-16;  // smaller errors are drawn here, because a logarithmic axis has no zero

void add_error(PlotPanel& panel, const PillarCheckCurve& curve, const SpecimenStyle& style) {
  PlotSeries error{.mark = Mark::kLine, .ink = style.ink, .size = 0.8};
  error.pattern = style.pattern;
  for (std::size_t i = 0; i < curve.time_s.size(); ++i) {
    const double relative = std::abs(curve.solver[i] / curve.exact[i] - 1.0);
    error.x.push_back(curve.time_s[i]);
    error.y.push_back(std::max(relative, kRounding));
  }
  panel.series.push_back(error);
}

// Adds a dashed line at the largest accepted error, from the first time of the panel to the last.
void add_limit(PlotPanel& panel, double limit) {
  PlotSeries line{.mark = Mark::kLine, .label = "limit", .ink = Ink::kGrey, .is_dashed = true};
  double first_s = INFINITY, last_s = 0.0;
  for (const PlotSeries& series : panel.series) {
    for (const double time_s : series.x) {
      if (time_s > 0.0) first_s = std::min(first_s, time_s);
      last_s = std::max(last_s, time_s);
    }
  }
  if (!(limit > 0.0) || !(last_s > first_s)) return;
  line.x = {first_s, last_s};
  line.y = {limit, limit};
  panel.series.push_back(line);
}

// The first value that is not zero, which is the instantaneous response.
double first_value(const std::vector<double>& values) {
  for (const double value : values) {
    if (std::isfinite(value) && value != 0.0) return value;
  }
  return 1.0;
}

void add_pillar_curve(PlotPanel& panel, const PillarCheckCurve& curve, const SpecimenStyle& style) {
  const double factor = 1.0 / first_value(curve.exact);
  PlotSeries exact{.mark = Mark::kLine, .ink = style.ink, .size = 0.9};
  exact.x = curve.time_s;
  exact.y = scaled(curve.exact, factor);
  PlotSeries solver{
      .mark = Mark::kPoints, .label = style.label, .ink = style.ink, .is_hollow = true};
  solver.size = 1.9;
  solver.pattern = exact.pattern = style.pattern;
  const std::size_t stride = std::max<std::size_t>(1, curve.time_s.size() / 40);
  for (std::size_t i = 0; i < curve.time_s.size(); i += stride) {
    solver.x.push_back(curve.time_s[i]);
    solver.y.push_back(curve.solver[i] * factor);
  }
  panel.series.push_back(exact);
  panel.series.push_back(solver);
}

}  // namespace

std::optional<Plot> pillar_plot(const ReportInput& input,
                                const std::vector<SpecimenEstimates>& estimates) {
  Plot plot{.title = "Pillar in relaxation and creep",
            .description = "Solver and exact solution, and the relative error, over time.",
            .columns = 2,
            .height_px = 520};
  plot.panels.resize(4);
  const char* titles[] = {"Relaxation", "Creep"};
  const char* label = "relative to the first value";
  for (std::size_t p = 0; p < 4; ++p) {
    plot.panels[p].x = {.label = "time (s)", .is_log = true};
    plot.panels[p].height_share = p < 2 ? 1.7 : 1.0;
    plot.panels[p].shares_x_with_below = p < 2;
    plot.panels[p].title = p < 2 ? titles[p] : "";
    plot.panels[p].y.label = p < 2 ? label : "relative error";
    plot.panels[p].y.is_log = p >= 2;
  }
  double limit = 0.0;
  const std::vector<SpecimenStyle> styles = styles_of(estimates);
  for (std::size_t i = 0; i < estimates.size(); ++i) {
    if (!input.specimens[i].pillar) continue;
    limit = input.specimens[i].pillar->limit;
    const PillarCheckCurve* curves[] = {&input.specimens[i].pillar->relaxation,
                                        &input.specimens[i].pillar->creep};
    for (std::size_t p = 0; p < 2; ++p) {
      add_pillar_curve(plot.panels[p], *curves[p], styles[i]);
      add_error(plot.panels[p + 2], *curves[p], styles[i]);
    }
  }
  for (std::size_t p = 2; p < 4; ++p) add_limit(plot.panels[p], limit);
  for (const PlotPanel& panel : plot.panels) {
    if (!has_something_to_draw(panel)) return std::nullopt;
  }
  return plot;
}

}  // namespace viscard
