#include "fit/large_strain/load_cycles.h"
#include "fit/large_strain/rubber_band.h"
#include "io/flow/large_strain/large_strain_files.h"
#include "models/maths/text_of_number.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

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

// The fitted stress along each test, with its relaxation or damage.
PlotSeries course_line(const FittedLargeStrain& fitted, Deformation deformation) {
  PlotSeries line;
  for (const LargeStrainTest& test : fitted.tests) {
    if (test.deformation != deformation) continue;
    const std::vector<double> stress_Pa = stresses_Pa(fitted.result.best(), test);
    for (std::size_t i = 0; i < stress_Pa.size(); ++i) {
      line.x.push_back(test.stretch[i]);
      line.y.push_back(kMPa * stress_Pa[i]);
    }
    line.x.push_back(test.stretch.back());
    line.y.push_back(std::numeric_limits<double>::quiet_NaN());  // breaks the line
  }
  return line;
}

// Stress against time since the start of each test: readings, and the fitted stress with its band.
PlotPanel time_panel(const FittedLargeStrain& fitted) {
  PlotPanel panel;
  panel.x.label = "time since the first reading (s)";
  panel.x.is_log = true;
  panel.y.label = "nominal stress (MPa)";
  for (std::size_t t = 0; t < fitted.tests.size(); ++t) {
    const LargeStrainTest& test = fitted.tests[t];
    const std::vector<double> stress_Pa = stresses_Pa(fitted.result.best(), test);
    const std::vector<double> se_Pa = stress_errors_Pa(fitted.result.best(), test);
    PlotSeries points, line, band;
    for (std::size_t i = 0; i < stress_Pa.size(); ++i) {
      const double time_s = test.time_s[i] - test.time_s.front();
      if (!(time_s > 0.0)) continue;
      const double half = kMPa * kNormal95 * se_Pa[i];
      points.x.push_back(time_s);
      points.y.push_back(kMPa * test.nominal_stress_Pa[i]);
      line.y.push_back(kMPa * stress_Pa[i]);
      band.y_low.push_back(line.y.back() - half);
      band.y_high.push_back(line.y.back() + half);
    }
    line.x = band.x = points.x;
    points.mark = Mark::kPoints;
    points.size = 1.5;
    band.mark = Mark::kBand;
    line.label = test.name;
    for (PlotSeries* series : {&band, &points, &line}) {
      series->ink = ink_of_series(t);
      series->pattern = static_cast<int>(t);
      panel.series.push_back(std::move(*series));
    }
  }
  return panel;
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
  const bool is_course = !best.terms.empty() || best.damage;
  PlotSeries line = is_course ? course_line(fitted, deformation)
                              : law_line(best, deformation, measured.low, measured.high);
  if (!is_course) add(band_of(best, deformation, line));
  line.label = name_of(deformation) + ", " + name_of(best.law.form) +
               (best.damage ? std::string("+") + kMullinsName
                : is_course ? " with " + counted(best.terms.size(), "term")
                            : "");
  add(std::move(line));
  PlotSeries points = readings_of(fitted, deformation);
  points.label = name_of(deformation) + ", measured";
  add(std::move(points));
}

// The tests of a foam: readings, and the law at their readings.
void add_foam_tests(const FittedLargeStrain& fitted, PlotPanel& panel) {
  for (std::size_t t = 0; t < fitted.tests.size(); ++t) {
    const LargeStrainTest test = sorted_by_stretch(fitted.tests[t]);
    PlotSeries line, points;
    points.mark = Mark::kPoints;
    points.size = 1.5;
    line.x = points.x = test.stretch;
    for (const double stress : stresses_Pa(fitted.result.best(), test))
      line.y.push_back(kMPa * stress);
    for (const double stress : test.nominal_stress_Pa) points.y.push_back(kMPa * stress);
    line.label = test.name + ", " + name_of(fitted.result.best());
    points.label = test.name + ", measured";
    for (PlotSeries* series : {&line, &points}) {
      series->ink = ink_of_series(t);
      series->pattern = static_cast<int>(t);
      panel.series.push_back(std::move(*series));
    }
  }
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
  if (fitted.result.best().foam) {
    panel.x.label = "stretch (shear: tangent of the angle)";
    plot.description = "Readings of all tests and the chosen foam.";
    add_foam_tests(fitted, panel);
    plot.panels = {panel};
    return plot;
  }
  for (std::size_t d = 0; d < deformation_names().size(); ++d) {
    add_deformation(fitted, d, highest, panel);
  }
  plot.panels = {panel};
  if (fitted.result.best().terms.empty()) return plot;
  plot.title += ", and against time";
  plot.description +=
      " The dashed law is that at once. Below: stress against time, with the 95 % band of law and "
      "terms.";
  plot.panels.push_back(time_panel(fitted));
  plot.height_px *= 2;
  return plot;
}

}  // namespace viscard
