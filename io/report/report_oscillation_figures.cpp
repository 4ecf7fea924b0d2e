#include "fit/intervals/fit_result.h"
#include "io/report/report_figures.h"
#include "io/report/report_numbers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace viscard {
namespace {

// Measured values as dots and the fit as a line, in one colour; the two differ in shape too.
struct CurvePair {
  PlotSeries measured, fitted;
};

CurvePair curve_pair(const std::vector<double>& x, const std::vector<double>& measured,
                     const std::vector<double>& fitted, Ink ink, int pattern,
                     const std::string& name) {
  CurvePair pair;
  pair.measured = {.mark = Mark::kPoints, .label = name, .x = x, .y = measured, .ink = ink};
  pair.measured.size = 1.6;
  pair.measured.pattern = pattern;
  pair.measured.is_hollow = true;
  pair.fitted = {.mark = Mark::kLine, .x = x, .y = fitted, .ink = ink};
  pair.fitted.size = 0.9;
  pair.fitted.pattern = pattern;
  return pair;
}

void add_pair(PlotPanel& panel, const CurvePair& pair) {
  panel.series.push_back(pair.measured);
  panel.series.push_back(pair.fitted);
}

std::vector<double> ratio_of(const std::vector<double>& above, const std::vector<double>& below) {
  std::vector<double> ratio;
  for (std::size_t i = 0; i < above.size(); ++i) ratio.push_back(above[i] / below[i]);
  return ratio;
}

PlotSeries residuals_of(const std::vector<double>& x, const std::vector<double>& measured,
                        const std::vector<double>& fitted, const std::vector<double>& sigma,
                        Ink ink, int pattern, const std::string& name) {
  PlotSeries series{.mark = Mark::kPoints, .label = name, .x = x, .ink = ink};
  series.pattern = pattern;
  series.is_hollow = true;
  series.size = 1.3;
  for (std::size_t i = 0; i < x.size(); ++i) {
    series.y.push_back((measured[i] - fitted[i]) / sigma[i]);
  }
  return series;
}

constexpr Ink kStorageInk = Ink::kBlue, kLossInk = Ink::kVermillion;

}  // namespace

std::optional<Plot> oscillation_plot(const FitResult& fit, bool is_master) {
  const FitCurves& curves = fit.curves;
  const std::size_t n = curves.time_s.size();
  if (n == 0 || curves.loss_measured.size() != n || curves.loss_fitted.size() != n) {
    return std::nullopt;
  }
  std::vector<double> moduli = curves.measured;
  const ShownUnit unit = shown_unit(curves.unit, moduli);
  const auto of = [&](const std::vector<double>& values) { return scaled(values, unit.per_si); };
  PlotPanel both, tan_delta, residual;
  both.y = {.label = fmt::format("modulus ({})", unit.text), .is_log = true};
  both.height_share = 2.0;
  add_pair(both, curve_pair(curves.time_s, of(curves.measured), of(curves.fitted), kStorageInk, 0,
                            "storage modulus E′"));
  add_pair(both, curve_pair(curves.time_s, of(curves.loss_measured), of(curves.loss_fitted),
                            kLossInk, 1, "loss modulus E″"));
  tan_delta.y = {.label = "tan δ", .is_log = true};
  tan_delta.height_share = 1.2;
  add_pair(tan_delta, curve_pair(curves.time_s, ratio_of(curves.loss_measured, curves.measured),
                                 ratio_of(curves.loss_fitted, curves.fitted), Ink::kGreen, 0, ""));
  residual.y.label = "residual/σ";
  residual.height_share = 1.2;
  residual.series = {residuals_of(curves.time_s, curves.measured, curves.fitted, curves.sigma,
                                  kStorageInk, 0, "storage"),
                     residuals_of(curves.time_s, curves.loss_measured, curves.loss_fitted,
                                  curves.loss_sigma, kLossInk, 1, "loss")};
  show_two_sigma(residual);
  Plot plot{.title = "Storage and loss modulus",
            .description =
                "Storage modulus, loss modulus and loss factor over frequency with the fit, and "
                "the differences over their standard deviation.",
            .height_px = 680};
  for (PlotPanel* panel : {&both, &tan_delta, &residual}) {
    panel->x = {.label = is_master ? "reduced frequency f aT (Hz)" : "frequency (Hz)",
                .is_log = true};
    panel->shares_x_with_below = panel != &residual;
    if (!has_something_to_draw(*panel)) return std::nullopt;
    plot.panels.push_back(*panel);
  }
  return plot;
}

std::optional<Plot> shift_plot(const ShiftReport& shift) {
  if (shift.temperature_C.empty()) return std::nullopt;
  PlotPanel panel;
  panel.x.label = "temperature (°C)";
  panel.y.label = "log₁₀ aT";
  PlotSeries band{.mark = Mark::kBand, .ink = Ink::kBlue};
  PlotSeries taken{.mark = Mark::kPoints, .label = "taken: " + shift.form_text, .ink = Ink::kBlue};
  taken.size = 1.8;
  PlotSeries free{.mark = Mark::kErrorBars, .label = "free, 95 % interval"};
  free.ink = Ink::kVermillion;
  free.is_hollow = true;
  free.pattern = 1;
  for (std::size_t i = 0; i < shift.temperature_C.size(); ++i) {
    const double half = kNormal95 * shift.log10_a_se[i];
    const double free_half = kNormal95 * shift.free_log10_a_se[i];
    band.x.push_back(shift.temperature_C[i]);
    band.y_low.push_back(shift.log10_a[i] - half);
    band.y_high.push_back(shift.log10_a[i] + half);
    free.x.push_back(shift.temperature_C[i]);
    free.y.push_back(shift.free_log10_a[i]);
    free.y_low.push_back(shift.free_log10_a[i] - free_half);
    free.y_high.push_back(shift.free_log10_a[i] + free_half);
  }
  taken.x = shift.temperature_C;
  taken.y = shift.log10_a;
  panel.series = {band, free, taken};
  if (!shift.law_temperature_C.empty()) {
    PlotSeries law{.mark = Mark::kLine, .label = shift.law_text, .ink = Ink::kBlack};
    law.x = shift.law_temperature_C;
    law.y = shift.law_log10_a;
    law.size = 0.8;
    panel.series.push_back(law);
  }
  const double span = shift.temperature_C.back() - shift.temperature_C.front();
  panel.x.min = shift.temperature_C.front() - 0.04 * span;
  panel.x.max = shift.temperature_C.back() + 0.04 * span;
  return Plot{.title = "Shift factors",
              .description =
                  "Shift factors of the isotherms over temperature: as taken with their "
                  "95 % band, free with their 95 % intervals, and the law.",
              .panels = {panel},
              .height_px = 400};
}

}  // namespace viscard
