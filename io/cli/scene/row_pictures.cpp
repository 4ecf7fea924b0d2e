#include "io/cli/scene/answer_pictures.h"
#include "io/pictures/picture_numbers.h"
#include "io/report/report_numbers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace viscard {
namespace {

// "crosstalk_percent" -> "crosstalk", because the axis shows the unit.
std::string words_of(std::string name) {
  if (const std::size_t at = name.find("_percent"); at != std::string::npos) name.erase(at, 8);
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

std::string labelled(const std::string& name, const std::string& unit) {
  return unit.empty() || unit == "1" ? words_of(name) : words_of(name) + " (" + unit + ")";
}

// "centre_voltage_12" -> "centre_voltage" and 12; 0 without a number.
std::pair<std::string, int> stem_and_pillar(const std::string& name) {
  const std::size_t end = name.find_last_not_of("0123456789");
  const bool has_number = end != std::string::npos && name[end] == '_' && end + 1 < name.size() &&
                          name.size() - end < 8;
  if (!has_number) return {name, 0};
  return {name.substr(0, end), std::stoi(name.substr(end + 1))};
}

// The results of one name, pillar after pillar.
struct OverPillars {
  std::string name, unit;
  std::vector<double> pillar, value, error;
};

std::vector<OverPillars> grouped(const std::vector<SceneResult>& results) {
  std::vector<OverPillars> groups;
  for (const SceneResult& result : results) {
    const auto [stem, pillar] = stem_and_pillar(result.name);
    if (pillar == 0 || !std::isfinite(result.value)) continue;
    auto at = std::find_if(groups.begin(), groups.end(),
                           [&, &name = stem](const OverPillars& g) { return g.name == name; });
    if (at == groups.end()) at = groups.insert(groups.end(), {stem, result.unit, {}, {}, {}});
    at->pillar.push_back(pillar);
    at->value.push_back(result.value);
    at->error.push_back(result.error_estimate);
  }
  std::erase_if(groups, [](const OverPillars& g) { return g.pillar.size() < 2; });
  return groups;
}

// `loaded`: numbers of the pillars under a load; each is marked if they are not all.
Plot plot_over_pillars(const OverPillars& group, const std::vector<int>& loaded) {
  const bool is_log = spans_decades(group.value);
  // Logarithmic axes stay in the base unit; linear ones get a prefix.
  const ShownUnit unit = is_log ? ShownUnit{1.0, group.unit} : shown_unit(group.unit, group.value);
  PlotSeries dots{.mark = Mark::kErrorBars, .x = group.pillar};
  for (std::size_t i = 0; i < group.value.size(); ++i) {
    const double y = unit.per_si * (is_log ? std::abs(group.value[i]) : group.value[i]);
    const double half = unit.per_si * group.error[i];
    dots.y.push_back(y);
    dots.y_low.push_back(is_log ? std::max(y - half, 1e-2 * y) : y - half);
    dots.y_high.push_back(y + half);
  }
  PlotPanel panel;
  panel.x = {
      .label = "pillar", .min = group.pillar.front() - 1.0, .max = group.pillar.back() + 1.0};
  panel.y = {.label = (is_log ? "size of " : "") + labelled(group.name, unit.text),
             .is_log = is_log};
  const auto [low, high] = std::minmax_element(dots.y.begin(), dots.y.end());
  PlotSeries mark{.label = loaded.size() > 1 ? "loaded pillars" : "loaded pillar",
                  .ink = Ink::kVermillion,
                  .is_dashed = true};
  for (const int pillar : loaded) {
    mark.x.insert(mark.x.end(), {static_cast<double>(pillar), static_cast<double>(pillar), NAN});
    mark.y.insert(mark.y.end(), {*low, *high, NAN});  // NAN separates the lines
  }
  panel.series.push_back(std::move(dots));
  if (!mark.x.empty()) panel.series.push_back(std::move(mark));
  Plot plot;
  plot.title = words_of(group.name);
  plot.description = plot.title + " of each pillar of the row, with its estimated error";
  plot.panels.push_back(std::move(panel));
  return plot;
}

// A parameter of a sweep.
struct SweepKey {
  const char* name;
  double ArrayGeometry::*of;
  std::size_t values;
};

// The spacing if several parameters have as many values.
SweepKey key_with_most_values(const ArraySweep& sweep) {
  const SweepKey keys[] = {
      {"spacing", &ArrayGeometry::spacing_m, sweep.spacing_m.size()},
      {"diameter", &ArrayGeometry::diameter_m, sweep.diameter_m.size()},
      {"film thickness", &ArrayGeometry::film_thickness_m, sweep.thickness_m.size()}};
  return *std::max_element(std::begin(keys), std::end(keys),
                           [](const auto& a, const auto& b) { return a.values < b.values; });
}

// The label of a line: the parameters that vary besides the abscissa.
std::string others_of(const ArraySweep& sweep, const ArrayGeometry& g, const SweepKey& abscissa) {
  std::string text;
  const auto add = [&](const char* name, std::size_t values, double ArrayGeometry::*of) {
    if (of == abscissa.of || values < 2) return;
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", name, in_unit(g.*of, "m"));
  };
  add("diameter", sweep.diameter_m.size(), &ArrayGeometry::diameter_m);
  add("spacing", sweep.spacing_m.size(), &ArrayGeometry::spacing_m);
  add("film", sweep.thickness_m.size(), &ArrayGeometry::film_thickness_m);
  return text;
}

PlotSeries limit_line(const PlotPanel& panel, double limit) {
  PlotSeries line{.label = "limit", .ink = Ink::kGrey, .is_dashed = true};
  double low = HUGE_VAL;
  double high = -HUGE_VAL;
  for (const PlotSeries& series : panel.series) {
    for (const double x : series.x) low = std::min(low, x), high = std::max(high, x);
  }
  line.x = {low, high, high, low, high};
  line.y = {limit, limit, NAN, -limit, -limit};  // NAN separates the two lines
  return line;
}

Plot plot_over_sweep(const ArraySweep& sweep, const std::vector<SweepPoint>& points,
                     const std::map<std::size_t, SweepRow>& rows, std::size_t column) {
  const SweepKey key = key_with_most_values(sweep);
  const SceneResult& first = rows.begin()->second.results[column];
  std::vector<double> values;
  for (const auto& [i, row] : rows) values.push_back(row.results[column].value);
  const ShownUnit unit = shown_unit(first.unit, values);
  PlotPanel panel;
  std::vector<double> abscissae_m;
  for (const SweepPoint& point : points) abscissae_m.push_back(point.scene.geometry.*key.of);
  const ShownUnit x_unit = shown_unit("m", abscissae_m);
  panel.x.label = fmt::format("{} ({})", key.name, x_unit.text);
  panel.y.label = labelled(stem_and_pillar(first.name).first, unit.text);
  std::map<std::string, std::size_t> line_of;
  for (const auto& [i, row] : rows) {
    const ArrayGeometry& g = points[i].scene.geometry;
    const std::string name = others_of(sweep, g, key);
    const auto [at, is_new] = line_of.try_emplace(name, panel.series.size());
    if (is_new) panel.series.push_back({.label = name, .ink = ink_of_series(at->second)});
    panel.series[at->second].x.push_back(x_unit.per_si * (g.*key.of));
    panel.series[at->second].y.push_back(unit.per_si * row.results[column].value);
  }
  const std::size_t lines = panel.series.size();
  for (std::size_t i = 0; i < lines; ++i) {
    PlotSeries dots = panel.series[i];  // at the points of the sweep
    dots.mark = Mark::kPoints;
    dots.label.clear();
    panel.series.push_back(std::move(dots));
  }
  if (first.name.starts_with("deviation_percent") && sweep.limit_percent > 0.0) {
    panel.series.push_back(limit_line(panel, sweep.limit_percent));
  }
  Plot plot{.title = words_of(first.name), .panels = {}};
  plot.description = plot.title + " against " + key.name;
  plot.panels.push_back(std::move(panel));
  plot.height_px = 420;
  return plot;
}

}  // namespace

Pictures pictures_over_pillars(const SceneAnswer& answer, const std::vector<int>& loaded) {
  Pictures pictures;
  // Curves and maps have their own pictures.
  if (!answer.curves.empty() || !answer.maps.empty()) return pictures;
  for (const OverPillars& group : grouped(answer.results)) {
    if (!draw(group.name, plot_over_pillars(group, loaded), "row", pictures)) return {};
  }
  return pictures;
}

Pictures pictures_over_sweep(const ArraySweep& sweep, const std::vector<SweepPoint>& points,
                             const std::map<std::size_t, SweepRow>& rows) {
  Pictures pictures;
  if (rows.size() < 2 || key_with_most_values(sweep).values < 2) return pictures;
  for (std::size_t column = 0; column < rows.begin()->second.results.size(); ++column) {
    const std::string& name = rows.begin()->second.results[column].name;
    if (!draw(name, plot_over_sweep(sweep, points, rows, column), "row", pictures)) return {};
  }
  return pictures;
}

}  // namespace viscard
