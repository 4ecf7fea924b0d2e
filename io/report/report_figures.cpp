#include "io/report/report_figures.h"

#include "fit/intervals/fit_result.h"
#include "io/report/report_numbers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace viscard {
namespace {

constexpr int kPointsPerCurve = 240;

// From a twentieth of the shortest relaxation time to ten times the longest, over all specimens.
std::vector<double> shared_times(const std::vector<SpecimenEstimates>& estimates) {
  double first_s = 0.0, last_s = 0.0;
  for (const SpecimenEstimates& specimen : estimates) {
    for (const TermEstimate& term : specimen.terms) {
      const double tau_s = term.tau_s.value;
      if (!(tau_s > 0.0) || !std::isfinite(tau_s)) continue;
      if (first_s == 0.0 || tau_s < first_s) first_s = tau_s;
      last_s = std::max(last_s, tau_s);
    }
  }
  if (first_s == 0.0) return {};
  first_s *= 0.05;
  last_s *= 10.0;
  std::vector<double> time_s;
  for (int i = 0; i < kPointsPerCurve; ++i) {
    time_s.push_back(first_s * std::pow(last_s / first_s, i / (kPointsPerCurve - 1.0)));
  }
  return time_s;
}

PlotSeries line(const std::vector<double>& x, const std::vector<double>& y, Ink ink,
                const std::string& label) {
  return {.mark = Mark::kLine, .label = label, .x = x, .y = y, .ink = ink};
}

// Adds one specimen's curve and band, times `factor`.
void add_relaxation(PlotPanel& panel, const RelaxationBand& band, double factor,
                    const SpecimenStyle& style) {
  if (!band.low.empty()) {
    panel.series.push_back({.mark = Mark::kBand,
                            .x = band.time_s,
                            .y_low = scaled(band.low, factor),
                            .y_high = scaled(band.high, factor),
                            .ink = style.ink});
  }
  panel.series.push_back(line(band.time_s, scaled(band.value, factor), style.ink, style.label));
  panel.series.back().pattern = style.pattern;
}

PlotSeries truth_line(const Material& truth, const std::vector<double>& time_s, double factor,
                      const std::string& label) {
  const PronySeries series = young_series(truth);
  PlotSeries dashed = line(time_s, {}, Ink::kBlack, label);
  for (const double t : time_s) dashed.y.push_back(factor * relaxation_modulus_Pa(series, t));
  dashed.is_dashed = true;
  dashed.size = 0.7;
  return dashed;
}

PlotSeries error_bars(Ink ink, const std::string& label) {
  return {.mark = Mark::kErrorBars, .label = label, .ink = ink};
}

void add_point(PlotSeries& series, double x, double y, const Interval& y_range) {
  series.x.push_back(x);
  series.y.push_back(y);
  const bool has_range = y_range.high > y_range.low;
  series.y_low.push_back(has_range ? y_range.low : y);
  series.y_high.push_back(has_range ? y_range.high : y);
}

void add_law(PlotPanel& panel, const MixingLaw& law, double factor) {
  panel.series.push_back({.mark = Mark::kBand,
                          .x = law.ratio,
                          .y_low = scaled(law.E0_low_Pa, factor),
                          .y_high = scaled(law.E0_high_Pa, factor),
                          .ink = Ink::kGrey});
  panel.series.push_back(
      line(law.ratio, scaled(law.E0_Pa, factor), Ink::kGrey, "joint fit, 95 % band"));
}

PlotSeries spectrum_of(const SpecimenEstimates& specimen, const SpecimenStyle& style) {
  PlotSeries series = error_bars(style.ink, style.label);
  series.pattern = style.pattern;
  for (const TermEstimate& term : specimen.terms) {
    add_point(series, term.tau_s.value, term.g.value, term.g.interval_95);
    const Interval& tau = term.tau_s.interval_95;
    const bool has_range = tau.high > tau.low;
    series.x_low.push_back(has_range ? tau.low : term.tau_s.value);
    series.x_high.push_back(has_range ? tau.high : term.tau_s.value);
  }
  return series;
}

PlotSeries true_spectrum(const Material& truth, const std::string& label) {
  PlotSeries series{.mark = Mark::kPoints, .label = label, .ink = Ink::kBlack, .is_hollow = true};
  series.size = 3.2;
  for (const MaxwellTerm& term : young_series(truth).terms) {
    series.x.push_back(term.relaxation_time_s);
    series.y.push_back(term.modulus_Pa / truth.E0_Pa);
  }
  return series;
}

}  // namespace

std::optional<Plot> relaxation_plot(const ReportInput& input,
                                    const std::vector<SpecimenEstimates>& estimates) {
  const std::vector<double> time_s = shared_times(estimates);
  if (time_s.empty()) return std::nullopt;
  const ShownUnit unit = modulus_unit(estimates);
  Plot plot{
      .title = "Relaxation of all specimens",
      .description = "Relaxation modulus over time, absolute and relative to its first value.",
      .columns = 2,
      .height_px = 400};
  plot.panels.resize(2);
  const char* symbol = estimates.front().is_stiffness ? "stiffness R(t)" : "E(t)";
  plot.panels[0].y.label = fmt::format("{} ({})", symbol, unit.text);
  if (have_own_units(estimates)) {  // a liquid falls to zero: four decades below the softest
    constexpr double kDecades = 1e-4;
    double softest = std::numeric_limits<double>::infinity();
    for (const SpecimenEstimates& one : estimates) softest = std::min(softest, one.E0_Pa.value);
    plot.panels[0].y.is_log = true;
    plot.panels[0].y.min = kDecades * softest * unit.per_si;
  }
  plot.panels[1].y.label = estimates.front().is_stiffness ? "R(t)/R(0)" : "E(t)/E₀";
  for (PlotPanel& panel : plot.panels) panel.x = {.label = "time t (s)", .is_log = true};
  const std::vector<SpecimenStyle> styles = styles_of(estimates);
  for (std::size_t i = 0; i < estimates.size(); ++i) {
    for (std::size_t p = 0; p < 2; ++p) {
      const bool is_relative = p == 1;
      add_relaxation(plot.panels[p], relaxation_band(estimates[i], time_s, is_relative),
                     is_relative ? 1.0 : unit.per_si, styles[i]);
    }
  }
  const char* truth_label = "truth";  // one entry in the legend, after the specimens
  for (std::size_t i = 0; i < estimates.size(); ++i) {
    const std::optional<EmulatedTruth>& truth = input.specimens[i].truth;
    if (!truth || estimates[i].is_stiffness) continue;
    const double relative = 1.0 / truth->material.E0_Pa;
    plot.panels[0].series.push_back(truth_line(truth->material, time_s, unit.per_si, truth_label));
    plot.panels[1].series.push_back(truth_line(truth->material, time_s, relative, truth_label));
    truth_label = "";
  }
  return plot;
}

std::optional<Plot> ratio_plot(const ReportInput& input,
                               const std::vector<SpecimenEstimates>& estimates) {
  std::set<double> ratios;
  for (const SpecimenEstimates& specimen : estimates) {
    if (specimen.mixing_ratio > 0.0 && !specimen.is_stiffness) ratios.insert(specimen.mixing_ratio);
  }
  if (ratios.size() < 2) return std::nullopt;
  const ShownUnit unit = modulus_unit(estimates);
  PlotSeries total = error_bars(Ink::kSky, "with the systematic part");
  PlotSeries random = error_bars(Ink::kBlue, "E₀, 95 % interval");
  PlotSeries truth{.mark = Mark::kPoints, .label = "truth", .ink = Ink::kBlack, .is_hollow = true};
  truth.size = 3.2;
  for (std::size_t i = 0; i < estimates.size(); ++i) {
    const SpecimenEstimates& specimen = estimates[i];
    if (!(specimen.mixing_ratio > 0.0) || specimen.is_stiffness) continue;
    const double value = specimen.E0_Pa.value * unit.per_si;
    const Interval all =
        combined_95(specimen.E0_Pa.interval_95, specimen.E0_Pa.value, specimen.systematic_relative);
    const Interval& own = specimen.E0_Pa.interval_95;
    add_point(total, specimen.mixing_ratio, value, {all.low * unit.per_si, all.high * unit.per_si});
    add_point(random, specimen.mixing_ratio, value,
              {own.low * unit.per_si, own.high * unit.per_si});
    if (!input.specimens[i].truth) continue;
    truth.x.push_back(specimen.mixing_ratio);
    truth.y.push_back(input.specimens[i].truth->material.E0_Pa * unit.per_si);
  }
  PlotPanel panel;
  panel.x.label = "mixing ratio, parts of base to one of curing agent";
  panel.y.label = fmt::format("E₀ ({})", unit.text);
  const double margin = 0.08 * (*ratios.rbegin() - *ratios.begin());
  panel.x.min = *ratios.begin() - margin;
  panel.x.max = *ratios.rbegin() + margin;
  if (input.law) add_law(panel, *input.law, unit.per_si);
  total.size = 0.9;
  panel.series.insert(panel.series.end(), {total, random});
  if (!truth.x.empty()) panel.series.push_back(truth);
  return Plot{.title = "Instantaneous modulus over mixing ratio",
              .description = "E0 of every specimen over the mixing ratio, with its 95 % interval.",
              .panels = {panel},
              .width_px = 510,
              .height_px = 360};
}

std::optional<Plot> spectrum_plot(const ReportInput& input,
                                  const std::vector<SpecimenEstimates>& estimates) {
  PlotPanel panel;
  panel.x = {.label = "relaxation time τ (s)", .is_log = true};
  panel.y.label = "relative modulus g";
  double smallest = INFINITY, largest = 0.0;
  const std::vector<SpecimenStyle> styles = styles_of(estimates);
  for (std::size_t i = 0; i < estimates.size(); ++i) {
    for (const TermEstimate& term : estimates[i].terms) {
      smallest = std::min(smallest, term.g.value);
      largest = std::max(largest, term.g.value);
    }
    if (!estimates[i].terms.empty()) {
      panel.series.push_back(spectrum_of(estimates[i], styles[i]));
    }
  }
  const char* truth_label = "truth";
  for (const SpecimenReport& specimen : input.specimens) {
    if (!specimen.truth) continue;
    panel.series.push_back(true_spectrum(specimen.truth->material, truth_label));
    truth_label = "";
  }
  panel.y.is_log = smallest > 0.0 && largest > 30.0 * smallest;
  if (!panel.y.is_log && smallest >= 0.0) panel.y.min = 0.0;
  if (!has_something_to_draw(panel)) return std::nullopt;
  return Plot{.title = "Relaxation spectrum",
              .description = "Relative moduli over relaxation times, both with 95 % intervals.",
              .panels = {panel},
              .width_px = 510,
              .height_px = 360};
}

}  // namespace viscard
