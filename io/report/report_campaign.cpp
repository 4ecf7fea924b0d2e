#include "io/plots/plot_svg.h"
#include "io/report/report_figures.h"
#include "io/report/report_numbers.h"
#include "io/report/report_tables.h"
#include "models/maths/text_of_number.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>

namespace viscard {
namespace {

std::map<double, std::vector<std::size_t>> specimens_by_ratio(
    const std::vector<SpecimenEstimates>& estimates) {
  std::map<double, std::vector<std::size_t>> by_ratio;
  for (std::size_t i = 0; i < estimates.size(); ++i) {
    by_ratio[estimates[i].mixing_ratio].push_back(i);
  }
  return by_ratio;
}

// The members of a ratio, those of one specimen together.
std::vector<std::vector<std::size_t>> touches_by_specimen(
    const std::vector<SpecimenEstimates>& estimates, const std::vector<std::size_t>& members) {
  std::vector<std::vector<std::size_t>> specimens;
  std::map<std::string, std::size_t> number_of;
  for (const std::size_t i : members) {
    const std::string& id = estimates[i].specimen_id;
    const auto [number, is_new] = number_of.emplace(id, specimens.size());
    if (id.empty() || is_new) {
      number->second = specimens.size();
      specimens.emplace_back();
    }
    specimens[number->second].push_back(i);
  }
  return specimens;
}

struct Spread {
  double mean = 0.0, deviation = 0.0, own_error = 0.0;
};

// specimens: the touches on each.
Spread spread_of(const std::vector<std::vector<Estimate>>& specimens) {
  const auto count = static_cast<double>(specimens.size());
  Spread spread;
  std::vector<double> errors, means;
  for (const std::vector<Estimate>& touches : specimens) {
    means.push_back(0.0);
    for (const Estimate& one : touches) {
      means.back() += one.value / static_cast<double>(touches.size());
      errors.push_back((one.interval_95.high - one.interval_95.low) / (2.0 * kNormal95));
    }
    spread.mean += means.back() / count;
  }
  for (const double mean : means) {
    spread.deviation += std::pow(mean - spread.mean, 2) / (count - 1.0);
  }
  spread.deviation = std::sqrt(spread.deviation);
  std::sort(errors.begin(), errors.end());
  spread.own_error = errors[errors.size() / 2];
  return spread;
}

std::string percent(double share) {
  return fmt::format("{:.2g} %", 100.0 * share);
}

// With few specimens the interval is only a guide to the number of digits.
std::string mean_html(const Spread& spread, double per_si) {
  const Interval digits{spread.mean - spread.deviation, spread.mean + spread.deviation};
  return number_html(spread.mean, per_si, spread.deviation > 0.0 ? &digits : nullptr);
}

}  // namespace

std::vector<SpecimenStyle> styles_of(const std::vector<SpecimenEstimates>& estimates) {
  const auto by_ratio = specimens_by_ratio(estimates);
  const bool is_campaign =
      by_ratio.size() > 1 && by_ratio.size() < estimates.size() && by_ratio.begin()->first > 0.0;
  std::vector<SpecimenStyle> styles(estimates.size());
  if (!is_campaign) {
    for (std::size_t i = 0; i < estimates.size(); ++i) {
      styles[i] = {ink_of_series(i), static_cast<int>(i), estimates[i].label};
    }
    return styles;
  }
  std::size_t number = 0;
  for (const auto& [ratio, members] : by_ratio) {
    for (const std::size_t i : members) {
      styles[i].ink = ink_of_series(number);
      styles[i].pattern = static_cast<int>(number);
    }
    styles[members.front()].label =
        fmt::format("{:g} : 1 ({})", ratio,
                    counted(touches_by_specimen(estimates, members).size(), "specimen"));
    ++number;
  }
  return styles;
}

HtmlTable spread_table(const std::vector<SpecimenEstimates>& estimates) {
  const ShownUnit unit = modulus_unit(estimates);
  const char* symbol = estimates.front().is_stiffness ? "R" : "E";
  HtmlTable table({{"Ratio", false},
                   {"Specimens"},
                   {fmt::format("Mean <i>{}</i><sub>0</sub> <span class=\"unit\">({})</span>",
                                symbol, escaped_markup(unit.text))},
                   {"between specimens"},
                   {"error of one fit"},
                   {"Mean relaxation <span class=\"unit\">(%)</span>"},
                   {"between specimens"},
                   {"error of one fit"}});
  for (const auto& [ratio, members] : specimens_by_ratio(estimates)) {
    const auto specimens = touches_by_specimen(estimates, members);
    if (specimens.size() < 2 || !(ratio > 0.0)) continue;
    std::vector<std::vector<Estimate>> E0(specimens.size()), relaxed(specimens.size());
    for (std::size_t s = 0; s < specimens.size(); ++s) {
      for (const std::size_t i : specimens[s]) {
        E0[s].push_back(estimates[i].E0_Pa);
        relaxed[s].push_back(estimates[i].sum_g);
      }
    }
    const Spread stiff = spread_of(E0), soft = spread_of(relaxed);
    table.add_row({fmt::format("<span class=\"nw\">{:g} : 1</span>", ratio),
                   std::to_string(specimens.size()), mean_html(stiff, unit.per_si),
                   percent(stiff.deviation / stiff.mean), percent(stiff.own_error / stiff.mean),
                   mean_html(soft, 100.0), percent(soft.deviation / soft.mean),
                   percent(soft.own_error / soft.mean)});
  }
  return table;
}

HtmlTable levels_table(const std::vector<Scatter>& scatter) {
  std::vector<HtmlTable::Column> columns{{"Level", false}};
  for (const Scatter& one : scatter) {
    const char* name = one.quantity == "ln_E0" ? "<i>E</i><sub>0</sub>" : "Σ<i>g</i>";
    columns.insert(columns.end(), {{std::string(name) + " <span class=\"unit\">(%)</span>"},
                                   {"95 %"},
                                   {"degrees of freedom"}});
  }
  HtmlTable table(columns);
  if (scatter.empty()) return table;
  for (const auto& [name, level] : {std::pair{"touches on one specimen", &Scatter::touch},
                                    std::pair{"specimens of one ratio", &Scatter::specimen},
                                    std::pair{"ratios about the law", &Scatter::ratio}}) {
    std::vector<std::string> row{name};
    for (const Scatter& one : scatter) {
      const ScatterLevel& at = one.*level;
      if (!is_identified(at)) {
        row.insert(row.end(), {"not identified: " + at.note, "–", "0"});
        continue;
      }
      row.insert(row.end(),
                 {number_html(at.deviation, 100.0, &at.interval_95) +
                      (at.note.empty() ? "" : "<br><span class=\"ci\">" + at.note + "</span>"),
                  interval_html(at.interval_95, 100.0), std::to_string(at.degrees_of_freedom)});
    }
    table.add_row(row);
  }
  return table;
}

std::optional<Plot> profile_plot(const FitResult& fit) {
  constexpr double kChiSquare95 = 3.841458820694124;
  constexpr double kHighest = 10.0;
  if (fit.profiles.empty()) return std::nullopt;
  Plot plot{.title = "Profile likelihoods",
            .description =
                "Rise of the residual sum of squares, divided by the noise variance, while one "
                "parameter is held and all others are fitted again.",
            .columns = static_cast<int>(std::min<std::size_t>(4, fit.profiles.size())),
            .height_px = 260};
  const auto rows = (fit.profiles.size() + static_cast<std::size_t>(plot.columns) - 1) /
                    static_cast<std::size_t>(plot.columns);
  plot.height_px *= static_cast<int>(rows);
  const ShownUnit unit = shown_unit(fit.is_stiffness ? "N/m" : "Pa", {fit.E_inf_Pa});
  for (const ProfileCurve& curve : fit.profiles) {
    const bool is_time = curve.parameter != "E_inf";
    PlotPanel panel;
    panel.x.label = is_time ? fmt::format("τ{} (s)", curve.parameter.substr(7))
                            : fmt::format("{} ({})", fit.is_stiffness ? "R∞" : "E∞", unit.text);
    panel.y = {.label = "rise of χ²", .min = 0.0, .max = kHighest};
    PlotSeries line{.mark = Mark::kLine, .ink = Ink::kBlue};
    for (std::size_t i = 0; i < curve.value.size(); ++i) {
      if (!std::isfinite(curve.value[i]) || curve.rise[i] > 1.5 * kHighest) continue;
      line.x.push_back(is_time ? std::exp(curve.value[i]) : curve.value[i] * unit.per_si);
      line.y.push_back(curve.rise[i]);
    }
    if (line.x.size() < 2) continue;
    PlotSeries limit{.mark = Mark::kLine, .ink = Ink::kGrey, .is_dashed = true};
    limit.x = {line.x.front(), line.x.back()};
    limit.y = {kChiSquare95, kChiSquare95};
    PlotSeries dots = line;
    dots.mark = Mark::kPoints;
    panel.series = {limit, line, dots};
    plot.panels.push_back(panel);
  }
  if (plot.panels.empty()) return std::nullopt;
  return plot;
}

std::optional<PlotPanel> spectrum_panel(const FitResult& fit) {
  if (!fit.spectrum || fit.spectrum->rows.empty()) return std::nullopt;
  const std::vector<SpectrumRow>& rows = fit.spectrum->rows;
  std::vector<double> high;
  for (const SpectrumRow& row : rows) high.push_back(row.H_95.high);
  std::vector<double> sorted = high;
  std::sort(sorted.begin(), sorted.end());
  const double largest = sorted.back();
  // Spectra of glasses fall by decades.
  constexpr double kDecades = 100.0, kFloor = 1e-3;
  const bool is_log =
      largest > kDecades * sorted[sorted.size() / 2] && sorted[sorted.size() / 4] > 0.0;
  const ShownUnit unit = shown_unit(fit.is_stiffness ? "N/m" : "Pa", high);
  PlotPanel panel;
  panel.title = "Continuous spectrum";
  panel.height_share = 2.0;
  panel.x = {.label = "relaxation time τ (s)", .is_log = true};
  panel.y = {.label = fmt::format("H(τ) ({})", unit.text), .is_log = is_log};
  if (!is_log) panel.y.min = 0.0;
  PlotSeries band{.mark = Mark::kBand, .label = "95 %, all spectra", .ink = Ink::kSky};
  PlotSeries line{.label = "smoothest spectrum", .ink = Ink::kBlue};
  const double floor = is_log ? kFloor * sorted[sorted.size() / 2] : 0.0;
  for (const SpectrumRow& row : rows) {
    band.x.push_back(row.tau_s);
    band.y_low.push_back(unit.per_si * std::max(row.H_95.low, floor));
    band.y_high.push_back(unit.per_si * std::max(row.H_95.high, floor));
    line.x.push_back(row.tau_s);
    line.y.push_back(unit.per_si * std::max(row.H_Pa, floor));
  }
  panel.series = {band, line};
  for (std::size_t i = 0; i < fit.terms.size(); ++i) {
    panel.notes.push_back({fit.terms[i].tau_s, fmt::format("τ{}", i + 1)});
  }
  return panel;
}

}  // namespace viscard
