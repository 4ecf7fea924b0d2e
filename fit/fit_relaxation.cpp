#include "fit/fit_relaxation.h"

#include "fit/assemble_result.h"
#include "fit/clean_data.h"
#include "fit/flags.h"
#include "fit/history_model.h"
#include "fit/step_curves.h"
#include "fit/step_model.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>

namespace viscard {
namespace {

using Index = Eigen::Index;
constexpr std::size_t kLeastRows = 4;

PronySeries plain_series(const SpectralModel& model, const SpectralState& state, bool is_liquid) {
  PronySeries series{is_liquid ? 0.0 : state.coefficients[0], {}};
  for (Index i = 0; i < state.n_terms(); ++i) {
    series.terms.push_back({state.coefficients[model.n_common() + i], std::exp(state.ln_tau[i])});
  }
  return series;
}

FitResult fit_strain_history(CleanColumns clean, const FitOptions& options) {
  HistoryInput input;
  input.time_s = clean.columns[0];
  input.output = clean.columns[1];
  input.input = clean.columns[2];
  while (input.contact + 1 < input.input.size() && input.input[input.contact + 1] == 0.0) {
    ++input.contact;  // strain begins to differ from zero after this sample
  }
  const HistoryModel model(input, options);
  const SpectralFit fit = fit_spectrum(
      model, log_time_blocks(model.row_time_s(), input.time_s[input.contact], 1), options);
  FitResult result;
  result.kind = FitKind::kRelaxation;
  fill_result(
      model, fit,
      [&](const SpectralState& state) { return plain_series(model, state, options.is_liquid); },
      result);
  const double zero_s = input.time_s[input.contact];
  const TestWindow window{shortest_step_s(input.time_s),
                          input.time_s[end_of_loading(input.input)] - zero_s, 0.0,
                          input.time_s.back() - zero_s};
  add_identifiability_flags(model, fit.state, fit.covariance, window, result);
  result.fit_from_s = input.time_s.front();
  result.fit_to_s = input.time_s.back();
  return result;
}

FitResult fit_step(const CleanColumns& clean, const FitOptions& options) {
  const StepModel model(clean.columns[0], clean.columns[1], StepShape::kRelaxation, options);
  std::vector<double> row_time_s;
  for (const LogBin& bin : model.bins()) row_time_s.push_back(bin.time_s);
  const SpectralFit fit = fit_spectrum(model, log_time_blocks(row_time_s, 0.0, 1), options);
  FitResult result;
  result.kind = FitKind::kRelaxation;
  fill_result(
      model, fit,
      [&](const SpectralState& state) { return plain_series(model, state, options.is_liquid); },
      result);
  const TestWindow window{shortest_step_s(clean.columns[0]), 0.0, clean.columns[0].front(),
                          clean.columns[0].back()};
  add_identifiability_flags(model, fit.state, fit.covariance, window, result);
  if (options.with_curves) fill_step_curves(model, fit, "Pa", result);
  result.fit_from_s = clean.columns[0].front();
  result.fit_to_s = clean.columns[0].back();
  return result;
}

// Rows before the step tell nothing about relaxation.
std::size_t drop_before_zero(CleanColumns& clean) {
  const auto first = std::lower_bound(clean.columns[0].begin(), clean.columns[0].end(), 0.0) -
                     clean.columns[0].begin();
  for (std::vector<double>& column : clean.columns)
    column.erase(column.begin(), column.begin() + first);
  return static_cast<std::size_t>(first);
}

}  // namespace

FitResult fit_relaxation(const RelaxationData& data, const FitOptions& options) {
  std::vector<std::vector<double>> columns{data.time_s, data.value};
  if (!data.strain.empty()) columns.push_back(data.strain);
  CleanColumns clean = clean_columns(std::move(columns), kLeastRows);
  std::size_t n_early = 0;
  if (data.strain.empty()) n_early = drop_before_zero(clean);
  if (clean.columns[0].size() < kLeastRows) {
    throw std::runtime_error("only " + std::to_string(clean.columns[0].size()) +
                             " rows lie at or after t = 0; a fit takes at least " +
                             std::to_string(kLeastRows) + ". Set the step's time with --time-zero");
  }
  if (!(clean.columns[0].back() > clean.columns[0].front())) {
    throw std::runtime_error("all rows have the same time; nothing can be said of relaxation");
  }
  const double sum = std::accumulate(clean.columns[1].begin(), clean.columns[1].end(), 0.0);
  if (!(sum > 0.0) && data.strain.empty()) {
    throw std::runtime_error(
        "the fitted column is negative or zero on the whole: a relaxation modulus is positive. If "
        "the "
        "sign of the instrument is the other way, map the column with a minus: "
        "--column modulus_Pa=-NAME");
  }
  FitResult result = data.strain.empty() ? fit_step(clean, options)
                                         : fit_strain_history(std::move(clean), options);
  result.n_left_out = clean.n_left_out;
  if (n_early > 0) {
    result.flags.push_back({"samples-before-zero", 0,
                            std::to_string(n_early) + " samples before t = 0 were left out"});
  }
  return result;
}

}  // namespace viscard
