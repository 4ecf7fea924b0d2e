#include "io/report/report_tables.h"

#include "io/basics/words.h"
#include "io/plots/plot_svg.h"
#include "io/report/report_numbers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace viscard {
namespace {

std::string with_unit(const std::string& symbol_html, const std::string& unit) {
  return unit.empty() ? symbol_html
                      : symbol_html + " <span class=\"unit\">(" + escaped_markup(unit) + ")</span>";
}

std::string value_html(const Estimate& estimate, double per_si) {
  const bool has_interval = !interval_html(estimate.interval_95, per_si).empty();
  return number_html(estimate.value, per_si, has_interval ? &estimate.interval_95 : nullptr);
}

std::string interval_or_dash(const Estimate& estimate, double per_si) {
  const std::string interval = interval_html(estimate.interval_95, per_si);
  return interval.empty() ? "–" : interval;
}

std::string estimate_html(const Estimate& estimate, double per_si) {
  const std::string interval = interval_html(estimate.interval_95, per_si);
  return value_html(estimate, per_si) + (interval.empty() ? "" : "<br>" + interval);
}

// The same with the unit behind the number, if each specimen has its own.
std::string estimate_html(const Estimate& estimate, const ShownUnit& unit, bool is_own) {
  if (!is_own) return estimate_html(estimate, unit.per_si);
  const std::string interval = interval_html(estimate.interval_95, unit.per_si);
  return value_html(estimate, unit.per_si) + " <span class=\"unit\">" + escaped_markup(unit.text) +
         "</span>" + (interval.empty() ? "" : "<br>" + interval);
}

HtmlTable::RowStyle group_if(bool begins) {
  return begins ? HtmlTable::RowStyle::kBeginsGroup : HtmlTable::RowStyle::kPlain;
}

// Short names stay on one line.
std::string label_html(const std::string& label) {
  constexpr std::size_t kShort = 24;
  const std::string safe = escaped_markup(label);
  return length_in_characters(label) > kShort ? safe : "<span class=\"nw\">" + safe + "</span>";
}

std::string link_to(const SpecimenEstimates& estimates) {
  return fmt::format("<a href=\"#{}\">{}</a>", estimates.anchor, label_html(estimates.label));
}

std::string two_point_html(const std::optional<TwoPointModulus>& two_point, double per_si) {
  if (!two_point) return "–";
  const double half_Pa = 1.96 * two_point->se_Pa;
  const Interval interval{two_point->modulus_Pa - half_Pa, two_point->modulus_Pa + half_Pa};
  std::string html =
      estimate_html({two_point->modulus_Pa, half_Pa > 0.0 ? interval : Interval{}}, per_si);
  if (two_point->half_space_modulus_Pa > 0.0) {
    html +=
        "<br><span class=\"ci\">half-space " +
        number_html(two_point->half_space_modulus_Pa, per_si, half_Pa > 0.0 ? &interval : nullptr) +
        "</span>";
  }
  return html;
}

const char* verdict_html(Recovery recovery) {
  constexpr const char* kVerdicts[] = {
      "<span class=\"yes\">yes</span>", "<span class=\"yes\">with the systematic part</span>",
      "<span class=\"no\">no</span>", "no interval", "<span class=\"no\">not resolved</span>"};
  return kVerdicts[static_cast<std::size_t>(recovery)];
}

std::string difference_html(const RecoveredParameter& row) {
  const double relative = row.estimate.value / row.truth - 1.0;
  if (!std::isfinite(relative)) return "–";
  const std::string sign = relative < 0.0 ? "−" : "+";
  return fmt::format("{}{:.{}f} %", sign, std::abs(100.0 * relative),
                     std::abs(relative) < 0.01 ? 2 : 1);
}

}  // namespace

HtmlTable summary_table(const std::vector<SpecimenEstimates>& estimates) {
  const bool is_own = have_own_units(estimates);
  const ShownUnit common = modulus_unit(estimates);
  const std::string in_header = is_own ? "" : common.text;
  const bool has_ratio = std::any_of(estimates.begin(), estimates.end(), [](const auto& specimen) {
    return specimen.mixing_ratio > 0.0;
  });
  const bool has_two_point =
      std::any_of(estimates.begin(), estimates.end(),
                  [](const auto& specimen) { return specimen.two_point.has_value(); });
  const char* symbol = estimates.front().is_stiffness ? "R" : "E";
  std::vector<HtmlTable::Column> columns{{"Specimen", false}};
  if (has_ratio) columns.push_back({"Ratio"});
  columns.push_back({with_unit(fmt::format("<i>{}</i><sub>0</sub>", symbol), in_header)});
  columns.push_back({with_unit(fmt::format("<i>{}</i><sub>∞</sub>", symbol), in_header)});
  columns.insert(columns.end(),
                 {{with_unit("Relaxes by", "%")}, {"Terms"}, {with_unit("Systematic, 95 %", "%")}});
  if (has_two_point) columns.push_back({with_unit("Two-point modulus", common.text)});
  columns.push_back({"Flags"});
  HtmlTable table(columns);
  for (std::size_t i = 0; i < estimates.size(); ++i) {
    const SpecimenEstimates& specimen = estimates[i];
    std::vector<std::string> row{link_to(specimen)};
    if (has_ratio) {
      row.push_back(specimen.mixing_ratio > 0.0 ? fmt::format("{:g} : 1", specimen.mixing_ratio)
                                                : "–");
    }
    const ShownUnit unit = is_own ? modulus_unit({specimen}) : common;
    row.push_back(estimate_html(specimen.E0_Pa, unit, is_own));
    row.push_back(estimate_html(specimen.E_inf_Pa, unit, is_own));
    row.push_back(estimate_html(specimen.sum_g, 100.0));
    row.push_back(std::to_string(specimen.terms.size()));
    row.push_back(specimen.systematic_relative > 0.0
                      ? fmt::format("±{:.2g}", 196.0 * specimen.systematic_relative)
                      : "–");
    if (has_two_point) row.push_back(two_point_html(specimen.two_point, common.per_si));
    const std::string flags =
        specimen.flags.empty() ? "none" : std::to_string(specimen.flags.size());
    row.push_back(specimen.is_trustworthy ? flags : "<span class=\"no\">not to be trusted</span>");
    table.add_row(row, group_if(i > 0));
  }
  return table;
}

HtmlTable terms_table(const std::vector<SpecimenEstimates>& estimates) {
  std::vector<double> moduli;
  for (const SpecimenEstimates& specimen : estimates) {
    for (const TermEstimate& term : specimen.terms) moduli.push_back(term.modulus_Pa.value);
  }
  const bool is_stiffness = estimates.front().is_stiffness;
  const ShownUnit common = shown_unit(is_stiffness ? "N/m" : "Pa", moduli);
  const bool is_own = have_own_units(estimates);
  HtmlTable table({{"Specimen", false},
                   {"<i>i</i>"},
                   {"<i>g<sub>i</sub></i>"},
                   {"95 %"},
                   {with_unit("<i>τ<sub>i</sub></i>", "s")},
                   {"95 %"},
                   {with_unit(is_stiffness ? "<i>R<sub>i</sub></i>" : "<i>E<sub>i</sub></i>",
                              is_own ? "" : common.text)},
                   {"95 %"}});
  for (std::size_t k = 0; k < estimates.size(); ++k) {
    const ShownUnit unit = is_own ? modulus_unit({estimates[k]}) : common;
    const std::string behind =
        is_own ? " <span class=\"unit\">" + escaped_markup(unit.text) + "</span>" : "";
    for (std::size_t i = 0; i < estimates[k].terms.size(); ++i) {
      const TermEstimate& term = estimates[k].terms[i];
      table.add_row(
          {i == 0 ? label_html(estimates[k].label) : "", std::to_string(i + 1),
           value_html(term.g, 1.0), interval_or_dash(term.g, 1.0), value_html(term.tau_s, 1.0),
           interval_or_dash(term.tau_s, 1.0), value_html(term.modulus_Pa, unit.per_si) + behind,
           interval_or_dash(term.modulus_Pa, unit.per_si)},
          group_if(i == 0 && k > 0));
    }
  }
  return table;
}

HtmlTable recovery_table(const ReportInput& input,
                         const std::vector<SpecimenEstimates>& estimates) {
  HtmlTable table({{"Specimen", false},
                   {"Quantity", false},
                   {"Truth"},
                   {"Estimate"},
                   {"95 % interval"},
                   {"Difference"},
                   {"Truth inside?", false}});
  const ShownUnit modulus = modulus_unit(estimates);
  for (std::size_t k = 0; k < estimates.size(); ++k) {
    if (!input.specimens[k].truth || estimates[k].is_stiffness) continue;
    bool is_first = true;
    for (const RecoveredParameter& row :
         recovered_parameters(estimates[k], input.specimens[k].truth->material)) {
      const double per_si = row.unit == "Pa" ? modulus.per_si : 1.0;
      table.add_row({is_first ? label_html(estimates[k].label) : "",
                     with_unit(row.name_html, row.unit == "Pa" ? modulus.text : row.unit),
                     number_html(row.truth, per_si), value_html(row.estimate, per_si),
                     interval_or_dash(row.estimate, per_si), difference_html(row),
                     verdict_html(row.recovery)},
                    group_if(is_first && !table.is_empty()));
      is_first = false;
    }
  }
  return table;
}

RecoveryCount count_recovery(const ReportInput& input,
                             const std::vector<SpecimenEstimates>& estimates) {
  RecoveryCount count;
  for (std::size_t k = 0; k < estimates.size(); ++k) {
    if (!input.specimens[k].truth || estimates[k].is_stiffness) continue;
    const Material& truth = input.specimens[k].truth->material;
    for (const RecoveredParameter& row : recovered_parameters(estimates[k], truth)) {
      if (row.recovery == Recovery::kNoInterval) continue;
      ++count.n;
      count.n_inside += row.recovery == Recovery::kInside;
      count.n_inside_with_systematic += row.recovery == Recovery::kInsideWithSystematic;
      count.n_not_resolved += row.recovery == Recovery::kNotResolved;
    }
    const double error = std::abs(estimates[k].E0_Pa.value / truth.E0_Pa - 1.0);
    if (std::isfinite(error)) count.largest_E0_error = std::max(count.largest_E0_error, error);
  }
  return count;
}

HtmlTable orders_table(const FitResult& fit) {
  const std::string unit = fit.curves.unit.empty() ? "" : fit.curves.unit + "²";
  HtmlTable table({{"Terms"},
                   {with_unit("Residual sum of squares", unit)},
                   {"AICc, above best"},
                   {"BIC, above best"},
                   {"Cross-validation"},
                   {"", false}});
  double best_aicc = INFINITY, best_bic = INFINITY;
  for (const OrderRow& row : fit.orders) {
    if (std::isfinite(row.aicc)) best_aicc = std::min(best_aicc, row.aicc);
    if (std::isfinite(row.bic)) best_bic = std::min(best_bic, row.bic);
  }
  for (const OrderRow& row : fit.orders) {
    const auto above = [](double value, double best) {
      return std::isfinite(value) ? fmt::format("{:.1f}", value - best) : std::string("–");
    };
    table.add_row(
        {std::to_string(row.n_terms), readable_number(row.rss, 6), above(row.aicc, best_aicc),
         above(row.bic, best_bic), readable_number(row.cv, 4), row.is_chosen ? "chosen" : ""},
        row.is_chosen ? HtmlTable::RowStyle::kChosen : HtmlTable::RowStyle::kPlain);
  }
  return table;
}

}  // namespace viscard
