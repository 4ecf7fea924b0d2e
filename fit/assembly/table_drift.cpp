#include "fit/assembly/table_drift.h"

#include "fit/intervals/lack_of_fit.h"
#include "models/maths/text_of_number.h"

#include <algorithm>
#include <cmath>

namespace viscard {
namespace {

// Only if the options leave the order free: a fit of a given order may have structure for another
// reason.
bool may_try(const FitOptions& options) {
  return options.drift == TableDrift::kIfCalledFor && !options.n_terms &&
         options.constraints.empty() && !options.allow_negative;
}

bool is_better_with(const FitResult& plain, const FitResult& with, const TableExtent& table) {
  if (!with.drift || !with.lack_of_fit) return false;
  constexpr double kVeryStrong = 10.0;  // Kass & Raftery, J. Am. Stat. Assoc. 90 (1995) 773
  constexpr double kLargest = 0.1, kStandardErrors = 3.0;
  const double moved = std::abs(with.drift->per_s) * table.duration_s;
  const double variance = std::max(std::pow(with.noise.sigma, 2) * with.noise.inflation, 1e-300);
  const auto n_samples = static_cast<double>(with.n_samples);
  const double more = 1.0 + 2.0 * (static_cast<double>(with.terms.size()) -
                                   static_cast<double>(plain.terms.size()));
  const double n_effective = std::max(2.0, n_samples / with.noise.inflation);
  const double gain = (plain.rss - with.rss) / variance - more * std::log(n_effective);
  return gain > kVeryStrong && moved <= kLargest * table.largest &&
         std::abs(with.drift->per_s) > kStandardErrors * with.drift->se_per_s &&
         with.lack_of_fit->structure < 0.5 * plain.lack_of_fit->structure;
}

enum class DriftReason { kAskedFor, kOutOfContact, kStructure };

void note_drift(const TableExtent& table, DriftReason reason, FitResult& result) {
  constexpr double kSlowest = 3.0;  // the longest time that is searched, in records
  const double moved = result.drift->per_s * table.duration_s;
  std::string text = "a drift of " + text_of(moved, 3) + " " + table.unit + " in " +
                     text_of(table.duration_s, 3) + " s was fitted";
  if (reason == DriftReason::kOutOfContact) text += ", because readings out of contact allow it";
  if (reason == DriftReason::kStructure) text += ", because the residual without it has structure";
  const bool is_doubtful = reason != DriftReason::kAskedFor && moved < 0.0;
  if (is_doubtful) {
    result.flags.push_back(
        {"slower-relaxation", 0,
         "a relaxation slower than the record looks the same as the drift: E_inf is an upper bound "
         "only. --drift or --no-drift decides"});
    result.E_inf_interval_95.low =
        std::min(result.E_inf_interval_95.low, std::max(0.0, result.E_inf_Pa + kSlowest * moved));
  }
  result.flags.push_back({"drift-fitted", 0, text});
}

}  // namespace

void examine_rows(const SpectralModel& model, const SpectralFit& fit,
                  std::vector<double> row_time_s, double zero_s, FitResult& result) {
  for (double& time_s : row_time_s) time_s -= zero_s;
  result.lack_of_fit = lack_of_fit(model, fit.state, row_time_s, fit.rss);
  for (Eigen::Index j = 0; j < model.n_common(); ++j) {
    if (model.common()[static_cast<std::size_t>(j)].name != kDriftName) continue;
    result.drift = {fit.state.coefficients[j], std::sqrt(std::max(0.0, fit.covariance(j, j)))};
  }
}

FitResult fit_with_or_without_drift(const FitOptions& options, const TableExtent& table,
                                    const std::function<FitResult(TableDrift)>& fit) {
  const bool is_asked = options.drift == TableDrift::kFitted;
  FitResult result = fit(is_asked ? TableDrift::kFitted : TableDrift::kNone);
  // Tables with readings out of contact contain a drift that the user did not request.
  const DriftReason reason = is_asked       ? DriftReason::kAskedFor
                             : result.drift ? DriftReason::kOutOfContact
                                            : DriftReason::kStructure;
  const bool has_structure = result.lack_of_fit && result.lack_of_fit->is_significant;
  if (may_try(options) && has_structure) {
    FitResult with = fit(TableDrift::kFitted);
    if (is_better_with(result, with, table)) result = std::move(with);
  }
  if (result.drift) note_drift(table, reason, result);
  flag_lack_of_fit({.unit = table.unit}, result);
  return result;
}

}  // namespace viscard
