#include "fit/fit_relaxation.h"

#include "fit/assembly/assemble_result.h"
#include "fit/assembly/solid_or_liquid.h"
#include "fit/assembly/table_drift.h"
#include "fit/curves/history_model.h"
#include "fit/curves/step_model.h"
#include "fit/intervals/flags.h"
#include "fit/intervals/kept_rows.h"
#include "fit/intervals/lack_of_fit.h"
#include "fit/intervals/left_out.h"
#include "fit/intervals/positive_intervals.h"
#include "fit/intervals/time_rounding.h"
#include "fit/laws/law_fit.h"
#include "fit/samples/check_record.h"
#include "fit/samples/clean_data.h"
#include "fit/samples/cycle.h"
#include "fit/samples/decay.h"
#include "fit/samples/end_rows.h"
#include "fit/samples/reading_noise.h"
#include "fit/samples/rounded_times.h"
#include "fit/samples/spikes.h"
#include "models/maths/text_of_number.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace viscard {
namespace {

constexpr std::size_t kLeastStepRows = 4;

std::vector<double> copy_of(std::span<const double> column) {
  return {column.begin(), column.end()};
}

double largest_of(std::span<const double> column) {
  const Eigen::Map<const Eigen::ArrayXd> values(column.data(),
                                                static_cast<Eigen::Index>(column.size()));
  return values.size() == 0 ? 0.0 : values.abs().maxCoeff();
}

TableExtent extent_of(const CleanViews& clean, const std::string& unit) {
  return {clean.column(0).back() - clean.column(0).front(), largest_of(clean.column(1)), unit};
}

FitResult fit_history_once(const HistoryInput& input, const FitOptions& options) {
  const double zero_s = input.step_s.value_or(input.time_s[input.contact]);
  const HistoryModel model(input, options);
  const SpectralFit fit =
      fit_spectrum(model, log_time_blocks(model.row_time_s(), zero_s, 1), options);
  FitResult result;
  result.kind = FitKind::kRelaxation;
  fill_result(model, fit, relaxation_series_of(model, options.is_liquid), result);
  fit_laws(model, fit, result);
  examine_table(model, fit, zero_s, result);
  const TestWindow window{shortest_step_s(input.time_s), loading_s(input), 0.0,
                          input.time_s.back() - zero_s};
  add_identifiability_flags(model, fit.state, fit.covariance, window, result);
  report_first_modulus(input.step_s ? input.time_s.front() - *input.step_s : window.sampling_s,
                       result);
  result.fit_from_s = input.time_s.front();
  result.fit_to_s = input.time_s.back();
  if (options.with_curves) fill_history_curves(model, fit, "Pa", {zero_s}, result);
  if (options.keep_rows) {
    KeptRows kept{.shape = KeptRows::Shape::kHistory, .history = input, .zero_s = zero_s};
    kept.window = window;
    keep(std::move(kept), fit, result);
  }
  return result;
}

FitResult fit_strain_history(const CleanViews& clean, TableDrift drift, const FitOptions& options) {
  HistoryInput input;
  input.with_drift = drift == TableDrift::kFitted;
  input.time_s = copy_of(clean.column(0));
  input.output = copy_of(clean.column(1));
  input.input = copy_of(clean.column(2));
  while (input.contact + 1 < input.input.size() && input.input[input.contact + 1] == 0.0) {
    ++input.contact;  // the strain begins to differ from zero after this sample
  }
  if (input.contact + 1 == input.input.size() && input.input.front() == 0.0) {
    throw std::runtime_error(
        "the strain is zero in every row: no strain was applied, or the column is not the strain");
  }
  input.step_s = step_before(input.time_s, input.input);
  FitResult result = fit_solid_or_liquid(
      options, [&](const FitOptions& as) { return fit_history_once(input, as); });
  flag_step_before(input.step_s, input.time_s.front(), result);
  if (const double jump_s = sharpest_jump_s(input); jump_s > 0.0)
    report_jump("strain", jump_s, result);
  return result;
}

FitResult fit_step_once(std::span<const double> time_s, std::span<const double> value,
                        const std::optional<Cycle>& cycle, const FitOptions& options) {
  // Several tests together weigh all samples of one test alike.
  const ReadingNoise noise = options.keep_rows ? ReadingNoise{} : reading_noise(value);
  const StepModel model(time_s, value, StepShape::kRelaxation, options, noise, cycle);
  const SpectralFit fit = fit_spectrum(model, log_time_blocks(model.row_time_s(), 0.0, 1), options);
  FitResult result;
  result.kind = FitKind::kRelaxation;
  fill_result(model, fit, relaxation_series_of(model, options.is_liquid), result);
  fit_laws(model, fit, result);
  const TestWindow window{model.sampling_s(), 0.0, time_s.front(), time_s.back()};
  add_identifiability_flags(model, fit.state, fit.covariance, window, result);
  examine_table(model, fit, 0.0, result);
  report_first_modulus(window.from_s, result);
  if (options.with_curves) fill_step_curves(model, fit, "Pa", result);
  result.fit_from_s = time_s.front();
  result.fit_to_s = time_s.back();
  if (options.keep_rows) {
    KeptRows kept{.at = copy_of(time_s), .value = copy_of(value), .window = window};
    kept.with_drift = options.drift == TableDrift::kFitted;
    keep(std::move(kept), fit, result);
  }
  note_weights(model, noise, "Pa", result);
  return result;
}

FitResult fit_step(const CleanViews& clean, const std::string& unit, const FitOptions& options,
                   const std::optional<Cycle>& cycle = {}) {
  const TableExtent table = extent_of(clean, unit);
  std::vector<double> rest;  // without the cycle
  if (cycle) {
    rest = copy_of(clean.column(1));
    for (std::size_t i = 0; i < rest.size(); ++i) rest[i] -= cycle->at(clean.column(0)[i]);
  }
  const std::span<const double> value = cycle ? rest : clean.column(1);
  FitResult result = fit_with_or_without_drift(options, table, [&](TableDrift drift) {
    FitOptions one = options;
    one.drift = drift;
    return fit_solid_or_liquid(one, [&](const FitOptions& as) {
      return fit_step_once(clean.column(0), value, cycle, as);
    });
  });
  flag_rise(table.largest, result);
  return result;
}

// Residual of a step fit at each sample.
std::vector<double> residual_of(const FitResult& fit, std::span<const double> time_s,
                                std::span<const double> value) {
  std::vector<double> residual = copy_of(value);
  const double drift_per_s = fit.drift ? fit.drift->per_s : 0.0;
  for (std::size_t i = 0; i < residual.size(); ++i) {
    residual[i] -= fit.E_inf_Pa + drift_per_s * time_s[i];
  }
  for (const FittedTerm& term : fit.terms) {
    subtract_decay(time_s.data(), time_s.size(), 1.0 / term.tau_s, term.modulus_Pa,
                   residual.data());
  }
  return residual;
}

// The fit with a cycle in the record, if its noise has a memory and its residual one clear line.
void try_cycle(const CleanViews& clean, const std::string& unit, const FitOptions& options,
               FitResult& result) {
  constexpr double kMemory = 3.0, kLess = 0.9;
  if (!options.constraints.empty() || options.white_noise || result.noise.inflation < kMemory) {
    return;
  }
  const std::optional<Cycle> cycle = find_cycle(clean.column(0), clean.column(1));
  if (!cycle) return;
  FitResult with = fit_step(clean, unit, options, cycle);
  if (!(with.rss < kLess * result.rss)) return;
  result = std::move(with);
  result.flags.push_back(
      {"cycle-fitted", 0,
       "a cycle of " + text_of(1.0 / cycle->frequency_Hz, 3) + " s with an amplitude of " +
           text_of(cycle->amplitude(), 3) + " " + unit + " (" +
           text_of(100.0 * cycle->amplitude() / result.E0_Pa, 2) +
           " % of E0) was fitted beside the relaxation, as a room's temperature or a pump makes "
           "it; the curves are without it"});
}

// Fits, then fits again without the spikes that show in the residual. The second fit is made if the
// comparison with neighbours found spikes or could not be applied.
FitResult fit_robustly(CleanViews& clean, const std::string& unit, const FitOptions& options) {
  const EndRows ends = drop_end_rows(clean, StepRecord::kRelaxation);
  const std::vector<std::size_t> spikes = isolated_spikes(clean.steps(), clean.column(1));
  clean.drop(spikes);
  FitResult result = fit_step(clean, unit, options);
  std::size_t n_spikes = spikes.size();
  if (n_spikes > 0 || !is_evenly_sampled(clean.steps(), clean.column(0).size())) {
    const auto value = clean.column(1);
    const std::vector<std::size_t> outliers =
        outlying_samples(residual_of(result, clean.column(0), value), value, largest_of(value));
    if (!outliers.empty()) {
      clean.drop(outliers);
      n_spikes += outliers.size();
      result = fit_step(clean, unit, options);
    }
  }
  try_cycle(clean, unit, options, result);
  add_spikes(result, n_spikes);
  add_end_rows(result, ends, unit);
  return result;
}

void check_step_values(std::span<const double> time_s, std::span<const double> value, bool is_step,
                       const std::string& unit) {
  if (time_s.size() < kLeastStepRows) {
    throw std::runtime_error("only " + std::to_string(time_s.size()) +
                             " rows lie at or after t = 0; a fit needs at least " +
                             std::to_string(kLeastStepRows) +
                             ". Set the time of the step with --time-zero");
  }
  if (!(time_s.back() > time_s.front())) {
    throw std::runtime_error("all rows have the same time, so no relaxation can be fitted");
  }
  if (!is_step) return;
  if (unit.starts_with("N")) return check_sign(value, "the force of a relaxation", "force_N");
  check_sign(value, "a relaxation modulus", "modulus_Pa");
}

}  // namespace

FitResult fit_relaxation(const RelaxationData& data, const FitOptions& options) {
  const bool is_step = data.strain.empty();
  const std::optional<TimeRounding> rounding = time_rounding(data.time_s, data.n_missing);
  const bool is_spread = rounding && !rounding->time_s.empty();
  std::vector<std::span<const double>> columns{is_spread ? rounding->time_s : data.time_s,
                                               data.value};
  if (!is_step) columns.emplace_back(data.strain);
  CheckedRecord record(columns, kLeastStepRows,
                       is_step ? RecordKind::kRelaxation : RecordKind::kHistory);
  CleanViews& clean = record.clean;
  std::size_t n_early = 0;
  if (is_step) {  // rows before the step carry no information about relaxation
    const auto time_s = clean.column(0);
    n_early = static_cast<std::size_t>(std::lower_bound(time_s.begin(), time_s.end(), 0.0) -
                                       time_s.begin());
    clean.drop_first(n_early);
    if (!data.is_zero_known) check_clock(clean, record.notes);
  }
  check_step_values(clean.column(0), clean.column(1), is_step, data.unit);
  FitResult result;
  if (is_step) {
    result = fit_from_begin(record, [&] { return fit_robustly(clean, data.unit, options); });
  } else {
    const std::vector<std::size_t> spikes = isolated_spikes(clean.steps(), clean.column(1));
    clean.drop(spikes);
    if (!data.is_zero_known && begins_under_load(clean.column(2).front(), clean.column(2)))
      check_clock(clean, record.notes, kLatestStep);
    result = fit_from_begin(record, [&] {
      return fit_with_or_without_drift(options, extent_of(clean, data.unit), [&](TableDrift drift) {
        return fit_strain_history(clean, drift, options);
      });
    });
    add_spikes(result, spikes.size());
  }
  add_left_out(result, left_out::kNotANumber, clean.n_left_out());
  add_record_notes(record.notes, result);
  if (n_early > 0) {
    result.flags.push_back(
        {"samples-before-zero", 0, counted(n_early, "sample") + " before t = 0 left out"});
  }
  add_left_out(result, left_out::kBeforeZero, n_early);
  if (rounding) report_time_rounding(*rounding, result);
  if (is_step && data.zero_unsure_s > 0.0) widen_for_zero(data.zero_unsure_s, result);
  flag_left_out(result);
  keep_intervals_positive(options, result);
  return result;
}

}  // namespace viscard
