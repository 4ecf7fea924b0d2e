#include "io/report/report_rubber.h"

#include "io/plots/plot_svg.h"
#include "io/report/report_numbers.h"
#include "models/maths/text_of_number.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace viscard {
namespace {

bool is_given(const Interval& interval) {
  return interval.low != 0.0 || interval.high != 0.0;
}

// The interval with the systematic part (a relative standard uncertainty).
Estimate with_systematic(const Estimate& random, double relative) {
  if (!is_given(random.interval_95)) return random;
  const double added = kNormal95 * relative * random.value;
  const double below = std::hypot(random.value - random.interval_95.low, added);
  const double above = std::hypot(random.interval_95.high - random.value, added);
  return {random.value, {random.value - below, random.value + above}};
}

// Without an interval the value alone counts.
Interval range_of(const Estimate& estimate) {
  return is_given(estimate.interval_95) ? estimate.interval_95
                                        : Interval{estimate.value, estimate.value};
}

bool overlap(const Estimate& a, const Estimate& b) {
  const Interval one = range_of(a), other = range_of(b);
  return one.low <= other.high && other.low <= one.high;
}

void compare(const SpecimenEstimates& linear, const RubberReport& rubber, std::size_t specimen,
             std::size_t index, std::vector<ModulusComparison>& out) {
  const Estimate E0 = with_systematic(linear.E0_Pa, linear.systematic_relative);
  const Estimate E_inf = with_systematic(linear.E_inf_Pa, linear.systematic_relative);
  const Estimate at_once{rubber.E0_Pa, rubber.E0_Pa_95};
  const auto add = [&](const char* which, const Estimate& a, const Estimate& b) {
    out.push_back({specimen, index, which, a, b, overlap(a, b)});
  };
  if (rubber.terms.empty()) {
    const Interval span{std::min(range_of(E_inf).low, range_of(E0).low), range_of(E0).high};
    add("E0 to E_inf", {E0.value, span}, at_once);
    return;
  }
  add("E0", E0, at_once);
  add("E_inf", E_inf, {rubber.E_inf_Pa, rubber.E_inf_Pa_95});
}

const char* symbol_of(const std::string& which) {
  if (which == "E0") return "<i>E</i><sub>0</sub>, at once";
  if (which == "E_inf") return "<i>E</i><sub>∞</sub>, after all relaxation";
  return "between <i>E</i><sub>∞</sub> and <i>E</i><sub>0</sub> (rate not known)";
}

std::string with_interval(const Estimate& estimate, double per_si) {
  return number_html(estimate.value, per_si, &estimate.interval_95) + " " +
         interval_html(estimate.interval_95, per_si);
}

double relative_difference(const ModulusComparison& one) {
  return one.large_strain.value / one.linear.value - 1.0;
}

// E(t)/at rest of a law, on the times of the figure.
PlotSeries law_series(const RubberReport& rubber, const std::vector<double>& time_s,
                      double per_si) {
  PlotSeries line;
  line.label = rubber.name + ", " + rubber.law;
  line.is_dashed = true;
  for (const double time : time_s) {
    double left = 1.0;
    for (const MaterialTerm& term : rubber.terms) left += term.g * std::expm1(-time / term.tau_s);
    line.x.push_back(time);
    line.y.push_back(per_si * rubber.E0_Pa * left);
  }
  return line;
}

std::vector<double> figure_times(const ReportInput& input,
                                 const std::vector<SpecimenEstimates>& estimates) {
  double low_s = 0.1, high_s = 100.0;
  const auto include = [&](double tau_s) {
    low_s = std::min(low_s, 0.1 * tau_s);
    high_s = std::max(high_s, 10.0 * tau_s);
  };
  for (const SpecimenEstimates& one : estimates) {
    for (const TermEstimate& term : one.terms) include(term.tau_s.value);
  }
  for (const RubberReport& rubber : input.rubbers) {
    for (const MaterialTerm& term : rubber.terms) include(term.tau_s);
  }
  constexpr int kPoints = 120;
  std::vector<double> time_s;
  for (int i = 0; i <= kPoints; ++i) {
    time_s.push_back(low_s * std::pow(high_s / low_s, static_cast<double>(i) / kPoints));
  }
  return time_s;
}

Plot modulus_plot(const ReportInput& input, const std::vector<SpecimenEstimates>& estimates) {
  const ShownUnit unit = modulus_unit(estimates);
  const std::vector<double> time_s = figure_times(input, estimates);
  PlotPanel panel;
  panel.x.label = "time after a step (s)";
  panel.x.is_log = true;
  panel.y.label = "Young's modulus at rest (" + unit.text + ")";
  std::size_t number = 0;
  const auto add = [&](PlotSeries series) {
    series.ink = ink_of_series(number);
    panel.series.push_back(std::move(series));
  };
  for (const SpecimenEstimates& one : estimates) {
    const RelaxationBand band = relaxation_band(one, time_s, false);
    if (!band.low.empty()) {
      add({Mark::kBand,
           "",
           time_s,
           {},
           scaled(band.low, unit.per_si),
           scaled(band.high, unit.per_si)});
    }
    add({Mark::kLine, one.label + ", linear", time_s, scaled(band.value, unit.per_si)});
    ++number;
  }
  for (const RubberReport& rubber : input.rubbers) {
    add(law_series(rubber, time_s, unit.per_si));
    ++number;
  }
  Plot plot;
  plot.title = "Young's modulus at rest: linear and large-strain tests";
  plot.description = "Solid: linear tests with their 95 % bands; dashed: laws of rubber at rest.";
  plot.panels = {panel};
  return plot;
}

}  // namespace

std::vector<ModulusComparison> compare_rubbers(const ReportInput& input,
                                               const std::vector<SpecimenEstimates>& estimates) {
  std::vector<ModulusComparison> out;
  for (std::size_t i = 0; i < estimates.size(); ++i) {
    if (estimates[i].is_stiffness) continue;
    for (std::size_t j = 0; j < input.rubbers.size(); ++j) {
      compare(estimates[i], input.rubbers[j], i, j, out);
    }
  }
  return out;
}

std::vector<std::string> rubber_disagreements(const ReportInput& input) {
  std::vector<SpecimenEstimates> estimates;
  for (std::size_t i = 0; i < input.specimens.size(); ++i) {
    estimates.push_back(estimates_from_specimen(input.specimens[i], i));
  }
  std::vector<std::string> lines;
  for (const ModulusComparison& one : compare_rubbers(input, estimates)) {
    if (one.overlaps) continue;
    lines.push_back(
        fmt::format("{} and {} disagree on {} at rest: {} Pa and {} Pa ({:+.2g} %), and their 95 % "
                    "intervals do not overlap",
                    estimates[one.specimen].label, input.rubbers[one.rubber].name, one.which,
                    text_of(one.linear.value, 4), text_of(one.large_strain.value, 4),
                    100.0 * relative_difference(one)));
  }
  return lines;
}

void add_rubbers(Page& page, const ReportInput& input,
                 const std::vector<SpecimenEstimates>& estimates) {
  const std::vector<ModulusComparison> all = compare_rubbers(input, estimates);
  if (all.empty()) return;
  page.add_heading(2, "large-strain", "Linear and large-strain tests");
  const ShownUnit unit = modulus_unit(estimates);
  const std::string shown = " <span class=\"unit\">(" + escaped_markup(unit.text) + ")</span>";
  HtmlTable table({{"Linear test", false},
                   {"Large strain", false},
                   {"Young's modulus at rest", false},
                   {"linear" + shown},
                   {"large strain" + shown},
                   {"Difference (%)"},
                   {"95 % intervals", false}});
  std::size_t n_apart = 0;
  for (const ModulusComparison& one : all) {
    const RubberReport& rubber = input.rubbers[one.rubber];
    n_apart += one.overlaps ? 0 : 1;
    const std::string seen = rubber.t_max_s > 0.0
                                 ? fmt::format("; {} s to {} s", readable_number(rubber.t_min_s, 2),
                                               readable_number(rubber.t_max_s, 3))
                                 : "";
    table.add_row({escaped_markup(estimates[one.specimen].label),
                   escaped_markup(rubber.name + ": " + rubber.law + " (" + rubber.stretches + seen +
                                  ")" + (rubber.is_trustworthy ? "" : ", not to be trusted")),
                   symbol_of(one.which), with_interval(one.linear, unit.per_si),
                   with_interval(one.large_strain, unit.per_si),
                   fmt::format("{:+.2g}", 100.0 * relative_difference(one)),
                   one.overlaps ? "overlap" : "<b>do not overlap: the tests disagree</b>"},
                  one.overlaps ? HtmlTable::RowStyle::kPlain : HtmlTable::RowStyle::kChosen);
  }
  page.add_paragraph(
      n_apart == 0 ? "Where both can be compared, the tests agree within their intervals."
                   : fmt::format("{} of {} comparisons disagree: the 95 % intervals do not "
                                 "overlap. Different specimens, a misfit of the law at small "
                                 "strain, the Mullins effect or a systematic error of one test "
                                 "are usual causes.",
                                 n_apart, all.size()));
  page.add_table(
      table,
      "Young's modulus at rest of linear tests (with their systematic part) and of laws of "
      "rubber. Of a law without terms of relaxation the rate is not known.");
  page.add_figure(
      modulus_plot(input, estimates), "large_strain",
      "Modulus at rest after a step. Solid: linear tests with 95 % bands of their scatter; "
      "dashed: laws of rubber, level if they have no terms.");
}

}  // namespace viscard
