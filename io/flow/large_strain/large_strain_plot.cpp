#include "fit/large_strain/rubber_band.h"
#include "io/flow/large_strain/large_strain_files.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace viscard {
namespace {

constexpr double kMPa = 1e-6;

// Measured range of the tests of one deformation; empty (high < low) without any.
struct StretchRange {
  double low = 1.0, high = 0.0;
};
StretchRange measured_range(const FittedLargeStrain& fitted, Deformation deformation) {
  StretchRange range;
  bool has_any = false;
  for (const RubberTestSummary& test : fitted.result.tests) {
    if (test.deformation != deformation) continue;
    range.low = has_any ? std::min(range.low, test.least_stretch) : test.least_stretch;
    range.high = has_any ? std::max(range.high, test.largest_stretch) : test.largest_stretch;
    has_any = true;
  }
  return range;
}

// The law from one stretch to another.
PlotSeries law_line(const FittedRubber& fitted, Deformation deformation, double from, double to) {
  constexpr int kPoints = 160;
  PlotSeries line;
  for (int i = 0; i <= kPoints; ++i) {
    const double stretch = from + (to - from) * i / kPoints;
    line.x.push_back(stretch);
    line.y.push_back(kMPa * nominal_stress_Pa(fitted.law, deformation, stretch));
  }
  return line;
}

PlotSeries band_of(const FittedRubber& fitted, Deformation deformation, const PlotSeries& line) {
  PlotSeries band = line;
  band.mark = Mark::kBand;
  for (std::size_t i = 0; i < line.x.size(); ++i) {
    const double half = kMPa * kNormal95 * nominal_stress_se_Pa(fitted, deformation, line.x[i]);
    band.y_low.push_back(line.y[i] - half);
    band.y_high.push_back(line.y[i] + half);
  }
  band.y.clear();
  return band;
}

PlotSeries readings_of(const FittedLargeStrain& fitted, Deformation deformation) {
  PlotSeries points;
  points.mark = Mark::kPoints;
  points.size = 1.5;
  for (const LargeStrainTest& test : fitted.tests) {
    if (test.deformation != deformation) continue;
    for (std::size_t i = 0; i < test.stretch.size(); ++i) {
      points.x.push_back(test.stretch[i]);
      points.y.push_back(kMPa * test.nominal_stress_Pa[i]);
    }
  }
  return points;
}

void add_deformation(const FittedLargeStrain& fitted, std::size_t index, double highest,
                     PlotPanel& panel) {
  const auto deformation = static_cast<Deformation>(index);
  const FittedRubber& best = fitted.result.best();
  const StretchRange measured = measured_range(fitted, deformation);
  const bool is_measured = measured.high > measured.low;
  const auto add = [&](PlotSeries series) {
    series.ink = ink_of_series(index);
    series.pattern = static_cast<int>(index);
    panel.series.push_back(std::move(series));
  };
  const double from = is_measured ? measured.high : 1.0;
  const double end = std::min(best.stable[index].high_is_open ? highest : best.stable[index].high,
                              std::min(highest, is_measured ? 1.15 * measured.high : highest));
  if (end > from) {
    PlotSeries beyond = law_line(best, deformation, from, end);
    beyond.is_dashed = true;
    if (!is_measured) beyond.label = name_of(deformation) + ", not measured";
    beyond.ink = Ink::kGrey;
    panel.series.push_back(std::move(beyond));
  }
  if (!is_measured) return;
  PlotSeries line = law_line(best, deformation, measured.low, measured.high);
  add(band_of(best, deformation, line));
  line.label = name_of(deformation) + ", " + name_of(best.law.form);
  add(std::move(line));
  PlotSeries points = readings_of(fitted, deformation);
  points.label = name_of(deformation) + ", measured";
  add(std::move(points));
}

}  // namespace

Plot plot_of_large_strain(const FittedLargeStrain& fitted) {
  double highest = 1.0;
  for (const RubberTestSummary& test : fitted.result.tests) {
    highest = std::max(highest, test.largest_stretch);
  }
  Plot plot;
  plot.title = "Nominal stress against stretch";
  plot.description =
      "Readings of all tests and the chosen law with its 95 % band; dashed grey: "
      "where no test measured, up to the limit of stability.";
  plot.width_px = 900;
  plot.height_px = 520;
  PlotPanel panel;
  panel.x.label = "stretch";
  panel.y.label = "nominal stress (MPa)";
  for (std::size_t d = 0; d < deformation_names().size(); ++d) {
    add_deformation(fitted, d, highest, panel);
  }
  plot.panels = {panel};
  return plot;
}

}  // namespace viscard
