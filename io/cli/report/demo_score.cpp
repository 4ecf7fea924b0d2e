#include "io/cli/report/report_commands.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace viscard {
namespace {

constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();

void add_row(std::vector<ScoreRow>& rows, const std::string& specimen, const std::string& quantity,
             const std::string& unit, double truth, double estimate, const Interval& interval) {
  rows.push_back({specimen, quantity, unit, truth, estimate, interval,
                  interval.low <= truth && truth <= interval.high});
}

}  // namespace

std::vector<ScoreRow> score_rows(const std::string& specimen, const EmulatedTruth& truth,
                                 const Material& estimate) {
  std::vector<ScoreRow> rows;
  const MaterialUncertainty uncertainty = estimate.uncertainty.value_or(MaterialUncertainty{});
  add_row(rows, specimen, "E0", "MPa", truth.material.E0_Pa * 1e-6, estimate.E0_Pa * 1e-6,
          {uncertainty.E0_Pa_95.low * 1e-6, uncertainty.E0_Pa_95.high * 1e-6});
  const Interval none{kMissing, kMissing};
  for (std::size_t i = 0; i < truth.material.terms.size(); ++i) {
    const MaterialTerm& term = truth.material.terms[i];
    const bool has_term = i < estimate.terms.size() && i < uncertainty.terms.size();
    const std::string number = std::to_string(i + 1);
    add_row(rows, specimen, "g_" + number, "", term.g, has_term ? estimate.terms[i].g : kMissing,
            has_term ? uncertainty.terms[i].g_95 : none);
    add_row(rows, specimen, "tau_" + number, "s", term.tau_s,
            has_term ? estimate.terms[i].tau_s : kMissing,
            has_term ? uncertainty.terms[i].tau_s_95 : none);
  }
  return rows;
}

std::string table_from_scores(const std::vector<ScoreRow>& rows) {
  std::string table = fmt::format("{:<12}{:<7}{:>12}{:>12}   {:<27}{}\n", "specimen", "", "truth",
                                  "estimate", "95 % interval", "truth inside?");
  std::string last;
  for (const ScoreRow& row : rows) {
    table += fmt::format("{:<12}{:<7}{:>12.5g}{:>12.5g}   [{:>10.5g}, {:>10.5g}] {:<4}{}\n",
                         row.specimen == last ? "" : row.specimen, row.quantity, row.truth,
                         row.estimate, row.interval_95.low, row.interval_95.high, row.unit,
                         row.is_inside ? "yes" : "NO");
    last = row.specimen;
  }
  const auto n_inside =
      std::count_if(rows.begin(), rows.end(), [](const ScoreRow& row) { return row.is_inside; });
  table += fmt::format(
      "\n{} of {} intervals hold the truth. By their meaning, about one in twenty does not.\n",
      n_inside, rows.size());
  return table;
}

}  // namespace viscard
