#include "io/cli/scene/cost_output.h"
#include "io/pictures/picture_numbers.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <vector>

namespace viscard {
namespace {

constexpr double kLeastError = 1e-12;  // a logarithmic axis has no zero
constexpr const char* kOfEffects = "an effect left out, or as planned";

// Rows of one kind as dots of one colour: the first word of the discretisation, or the effects.
std::string kind_of(const CostRow& row) {
  if (row.effects != "all on") return kOfEffects;
  if (row.discretisation.rfind("graded", 0) == 0) return "graded p";
  return row.discretisation.substr(0, row.discretisation[0] == 'p' ? 1 : 2);
}

// Beside the dot: "p4/2" for graded p4 with two layers, "p4", "h1 5 µm", or what is left out.
std::string name_of(const CostRow& row) {
  if (row.effects != "all on") return row.effects;
  if (row.discretisation.rfind("graded", 0) == 0) {
    return fmt::format("p{}/{}", row.mesh.degree, row.mesh.layers);
  }
  const std::string kind = kind_of(row);
  return kind == "p" ? row.discretisation : kind + " " + in_unit(row.mesh.uniform_m, "m");
}

double shown_error(const CostRow& row) {
  return std::max(row.error, kLeastError);
}

PlotSeries pareto_line(const CostStudy& study) {
  std::vector<CostRow> front;
  std::copy_if(study.rows.begin(), study.rows.end(), std::back_inserter(front),
               [](const CostRow& row) { return row.is_on_front; });
  std::sort(front.begin(), front.end(),
            [](const CostRow& a, const CostRow& b) { return a.cpu_s < b.cpu_s; });
  PlotSeries line{.mark = Mark::kLine, .label = "Pareto front", .ink = Ink::kGrey};
  for (const CostRow& row : front) {
    line.x.push_back(row.cpu_s);
    line.y.push_back(shown_error(row));
  }
  return line;
}

// Across the whole picture, at the tolerance of the scene.
PlotSeries tolerance_line(const CostStudy& study) {
  double least = std::numeric_limits<double>::infinity(), largest = 0.0;
  for (const CostRow& row : study.rows) {
    least = std::min(least, row.cpu_s);
    largest = std::max(largest, row.cpu_s);
  }
  return {.mark = Mark::kLine,
          .x = {least, largest},
          .y = {study.tolerance, study.tolerance},
          .ink = Ink::kBlack,
          .is_dashed = true};
}

}  // namespace

Plot plot_from_study(const CostStudy& study, const std::string& scene) {
  PlotPanel panel;
  panel.x = {.label = "processor time (s)", .is_log = true};
  panel.y = {.label = "relative error", .is_log = true};
  constexpr std::size_t kTolerance = 1;  // its place among the series
  panel.series = {pareto_line(study), tolerance_line(study)};
  for (const char* kind : {"graded p", "h1", "h2", "p", kOfEffects}) {
    PlotSeries series{.mark = Mark::kPoints, .label = kind, .size = 3.0};
    for (const CostRow& row : study.rows) {
      if (kind_of(row) != kind) continue;
      series.x.push_back(row.cpu_s);
      series.y.push_back(shown_error(row));
      series.names.push_back(name_of(row));
    }
    series.ink = ink_of_series(panel.series.size() - 2);
    if (!series.x.empty()) panel.series.push_back(series);
  }
  Plot plot{.title = "What accuracy costs: " + scene,
            .description =
                "Relative error against processor time for each discretisation, with the front of "
                "those that no other beats in both and the tolerance of the scene. p4/2: graded "
                "elements of degree 4 with two layers at the rim.",
            .panels = {panel},
            .width_px = 860,
            .height_px = 520};
  plot.panels[0].series[kTolerance].label =
      "the scene's tolerance, " + number_on_axes(plot, study.tolerance);
  return plot;
}

}  // namespace viscard
