#include "io/cost/study_cost.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace viscard {
namespace {

// A row and its processor time. Half of the tolerance is for the row, half for the error of the
// reference.
CostAdvice advice_for(double tolerance, const CostStudy& study) {
  const std::vector<CostRow>& rows = study.rows;
  CostAdvice advice{tolerance, fmt::format("{:g}: none of these is accurate enough", tolerance)};
  if (!(study.reference_error <= 0.5 * tolerance)) {
    advice.text = std::isfinite(study.reference_error)
                      ? fmt::format("{:g}: the reference itself is known to {:.1e} only", tolerance,
                                    study.reference_error)
                      : fmt::format(
                            "{:g}: there was no time for a second reference, so that the "
                            "error of the first is not known",
                            tolerance);
    return advice;
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i].error > 0.5 * tolerance) continue;
    if (advice.row >= 0 && rows[static_cast<std::size_t>(advice.row)].cpu_s <= rows[i].cpu_s) {
      continue;
    }
    advice.row = static_cast<int>(i);
  }
  if (advice.row < 0) return advice;
  const CostRow& row = rows[static_cast<std::size_t>(advice.row)];
  advice.text = fmt::format("{:g}: {}, {} ({:.2g} ms, error {:.1e})", tolerance, row.discretisation,
                            row.effects, 1e3 * row.cpu_s, row.error);
  return advice;
}

}  // namespace

void rank_by_processor_time(CostStudy& study) {
  for (CostRow& row : study.rows) {
    row.is_on_front = std::none_of(study.rows.begin(), study.rows.end(), [&](const CostRow& other) {
      return other.cpu_s < row.cpu_s && other.error <= row.error;
    });
  }
  study.advice.clear();
  for (const double tolerance : {1e-1, 1e-2, 1e-3, 1e-4, 1e-5}) {
    study.advice.push_back(advice_for(tolerance, study));
  }
}

std::optional<LinearFactor> factor_over_linear(const CostStudy& study, double error) {
  const CostRow* quickest = nullptr;
  std::vector<const CostRow*> linear;
  for (const CostRow& row : study.rows) {
    if (row.effects != "all on") continue;
    if (row.discretisation.rfind("h1 ", 0) == 0) linear.push_back(&row);
    const bool reaches = row.error <= error && row.cpu_s > 0.0;
    if (reaches && (quickest == nullptr || row.cpu_s < quickest->cpu_s)) quickest = &row;
  }
  if (quickest == nullptr || linear.size() < 2) return std::nullopt;
  std::sort(linear.begin(), linear.end(),
            [](const CostRow* a, const CostRow* b) { return a->error > b->error; });
  std::size_t fine = 1;
  while (fine + 1 < linear.size() && linear[fine]->error > error) ++fine;
  const CostRow &coarser = *linear[fine - 1], &finer = *linear[fine];
  const double fall = std::log(coarser.error / finer.error);
  const double rise = std::log(finer.cpu_s / coarser.cpu_s);
  // Errors that hardly fall with the mesh come from something else, and no line leads to zero.
  constexpr double kSteepest = 5.0;  // time goes with the error to the -3 at the most
  if (!(fall > 0.0 && rise > 0.0 && rise < kSteepest * fall)) return std::nullopt;
  const double log_time = std::log(finer.cpu_s) + std::log(finer.error / error) * rise / fall;
  return LinearFactor{.error = error,
                      .factor = std::exp(log_time) / quickest->cpu_s,
                      .is_extrapolated = error < linear.back()->error,
                      .quickest = quickest->discretisation};
}

}  // namespace viscard
