#include "io/cli/scene/answer_pictures.h"

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <limits>

namespace viscard {
namespace {

constexpr int kPoints = 121;
constexpr double kUm = 1e6;  // pictures are in micrometres

std::vector<double> log_range(double from, double to) {
  std::vector<double> values;
  for (int i = 0; i < kPoints; ++i) {
    values.push_back(from * std::pow(to / from, static_cast<double>(i) / (kPoints - 1)));
  }
  return values;
}

PlotSeries curve(const std::string& label, const std::vector<double>& x, std::size_t number,
                 double x_scale, const std::function<double(double)>& y) {
  PlotSeries series;
  series.label = label;
  series.ink = ink_of_series(number);
  for (const double value : x) {
    series.x.push_back(x_scale * value);
    series.y.push_back(y(value));
  }
  return series;
}

Plot one_panel(const std::string& title, const std::string& description, PlotPanel panel) {
  Plot plot{.title = title, .description = description, .panels = {std::move(panel)}};
  plot.height_px = 420;
  return plot;
}

// Something against the spacing, one curve for half, once and twice the diameter.
PlotPanel by_diameter(const SensorGeometry& g, const char* y_label, bool is_log,
                      const std::function<double(double, double)>& of_d_s) {
  PlotPanel panel;
  panel.x = {"spacing (µm)", true};
  panel.y = {y_label, is_log};
  const std::vector<double> spacing_m = log_range(0.1 * g.spacing_m, 5.0 * g.spacing_m);
  std::size_t number = 0;
  for (const double factor : {0.5, 1.0, 2.0}) {
    const double d = factor * g.diameter_m;
    panel.series.push_back(curve(fmt::format("diameter {:.3g} µm", d * kUm), spacing_m, number++,
                                 kUm, [&](double s) { return of_d_s(d, s); }));
  }
  return panel;
}

Plot flaw_picture(const SensorMaterial& m, const SensorGeometry& g) {
  PlotPanel panel;
  panel.x = {"adhesion strength (kPa)", true};
  panel.y = {"widest pillar (µm)", true};
  const std::vector<double> strength_Pa = log_range(1e3, 1e7);
  panel.series.push_back(curve("flaw-insensitive below", strength_Pa, 0, 1e-3, [&](double Pa) {
    SensorMaterial other = m;
    other.adhesion_strength_Pa = Pa;
    return kUm * widest_flaw_insensitive_m(other);
  }));
  panel.series.push_back(
      curve("this design", strength_Pa, 1, 1e-3, [&](double) { return kUm * g.diameter_m; }));
  panel.series.back().is_dashed = true;
  return one_panel("Flaw insensitivity",
                   "Widest pillar whose contact parts uniformly, against the adhesion strength.",
                   std::move(panel));
}

// Lengths from which and up to which a pillar is admissible: everything below all limits.
Plot region_picture(const SensorGeometry& g, const SensorMaterial& m, const SensorRequirements& r) {
  PlotPanel panel;
  panel.x = {"spacing (µm)", true};
  panel.y = {"length (µm)", true, 0.2 * kUm * g.diameter_m, 40.0 * kUm * g.diameter_m};
  const std::vector<double> spacing_m = log_range(0.1 * g.spacing_m, 5.0 * g.spacing_m);
  PlotSeries band{.mark = Mark::kBand, .label = "admissible", .ink = Ink::kSky};
  for (const double s : spacing_m) {
    const LongestPillar longest = longest_pillar(g.diameter_m, s, m, r);
    const double nothing = std::numeric_limits<double>::quiet_NaN();
    band.x.push_back(kUm * s);
    band.y_low.push_back(longest.length_m > 0.0 ? 0.2 * kUm * g.diameter_m : nothing);
    band.y_high.push_back(longest.length_m > 0.0 ? kUm * longest.length_m : nothing);
  }
  panel.series.push_back(band);
  const double d = g.diameter_m;
  panel.series.push_back(curve("buckling", spacing_m, 0, kUm,
                               [&](double s) { return kUm * longest_unbuckled_m(d, s, m, r); }));
  panel.series.push_back(curve("matting", spacing_m, 1, kUm,
                               [&](double s) { return kUm * longest_unmatted_m(d, s, m); }));
  panel.series.push_back(curve("aspect ratio", spacing_m, 2, kUm,
                               [&](double) { return kUm * r.largest_aspect_ratio * d; }));
  PlotSeries here{.mark = Mark::kPoints, .label = "this design", .ink = Ink::kBlack};
  here.x = {kUm * g.spacing_m};
  here.y = {kUm * g.length_m};
  here.size = 2.0;
  panel.series.push_back(here);
  return one_panel("Admissible region",
                   fmt::format("Lengths below every limit at a diameter of {:.3g} µm.", d * kUm),
                   std::move(panel));
}

Plot diameters_picture(const SensorGeometry& g, const SensorMaterial& m,
                       const SensorRequirements& r) {
  PlotPanel panel;
  panel.x = {"diameter (µm)", true};
  panel.y = {"longest admissible pillar (µm)", true};
  const std::vector<double> diameter_m = log_range(0.1 * g.diameter_m, 10.0 * g.diameter_m);
  std::size_t number = 0;
  for (const double factor : {0.5, 1.0, 2.0}) {
    const double s = factor * g.spacing_m;
    panel.series.push_back(
        curve(fmt::format("spacing {:.3g} µm", s * kUm), diameter_m, number++, kUm, [&](double d) {
          const double length_m = longest_pillar(d, s, m, r).length_m;
          return length_m > 0.0 ? kUm * length_m : std::numeric_limits<double>::quiet_NaN();
        }));
  }
  return one_panel("Longest admissible pillar",
                   "Against the diameter; a curve ends where diameter or spacing alone fail.",
                   std::move(panel));
}

}  // namespace

std::vector<std::pair<std::string, Plot>> design_pictures(const SensorGeometry& g,
                                                          const SensorMaterial& m,
                                                          const SensorRequirements& r) {
  std::vector<std::pair<std::string, Plot>> pictures;
  pictures.emplace_back(
      "buckling", one_panel("Buckling", "Longest pillar that does not buckle, against spacing.",
                            by_diameter(g, "longest pillar (µm)", true, [&](double d, double s) {
                              return kUm * longest_unbuckled_m(d, s, m, r);
                            })));
  pictures.emplace_back(
      "matting",
      one_panel("Matting", "Longest pillar that does not stick to its neighbour, against spacing.",
                by_diameter(g, "longest pillar (µm)", true, [&](double d, double s) {
                  return kUm * longest_unmatted_m(d, s, m);
                })));
  pictures.emplace_back("flaw", flaw_picture(m, g));
  pictures.emplace_back(
      "sensitivity",
      one_panel("Sensitivity", "Voltage over that of a film without pillars, against spacing.",
                by_diameter(g, "relative sensitivity", true, [&](double d, double s) {
                  return stress_concentration(d, s, r.lattice);
                })));
  pictures.emplace_back("region", region_picture(g, m, r));
  pictures.emplace_back("longest", diameters_picture(g, m, r));
  return pictures;
}

}  // namespace viscard
