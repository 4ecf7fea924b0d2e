#include "fit/fit_creep.h"

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
#include "fit/samples/end_rows.h"
#include "fit/samples/reading_noise.h"
#include "fit/samples/rounded_times.h"
#include "fit/samples/spikes.h"
#include "models/material/retardation_spectrum.h"
#include "models/maths/text_of_number.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

namespace viscard {
namespace {

using Index = Eigen::Index;

PronySeries series_from_creep(const SpectralModel& model, const SpectralState& state,
                              bool is_liquid) {
  RetardationSpectrum spectrum;
  spectrum.instantaneous_compliance_1_Pa = state.coefficients[0];
  if (is_liquid) spectrum.fluidity_1_Pa_s = state.coefficients[1];
  for (Index i = 0; i < state.n_terms(); ++i) {
    spectrum.terms.push_back({state.coefficients[model.n_common() + i], std::exp(state.ln_tau[i])});
  }
  return relaxation_from_retardation(spectrum);
}

[[noreturn]] void refuse_without_E0() {
  throw std::runtime_error(
      "the record shows no instantaneous compliance (it begins at zero), so E0 of a series of "
      "terms would be infinite. For creep by a power of time, as of soft gels and cells, add "
      "--model springpot; otherwise start the record earlier after the step, or give fewer terms "
      "with --terms");
}

FitResult fit_creep_as(std::span<const double> time_s, std::span<const double> compliance_1_Pa,
                       const FitOptions& options) {
  // Several tests together weigh all samples of one test alike.
  const ReadingNoise noise = options.keep_rows ? ReadingNoise{} : reading_noise(compliance_1_Pa);
  const StepModel model(time_s, compliance_1_Pa, StepShape::kCreep, options, noise);
  const SpectralFit fit = fit_spectrum(model, log_time_blocks(model.row_time_s(), 0.0, 1), options);
  if (!(fit.state.coefficients[0] > 0.0)) {
    // In a fit of several tests another test may determine E0; creep then contributes what fewer
    // terms describe.
    const auto n_terms = static_cast<int>(fit.state.n_terms());
    if (options.keep_rows && n_terms > 0) {
      FitOptions fewer = options;
      fewer.max_terms = n_terms - 1;
      return fit_creep_as(time_s, compliance_1_Pa, fewer);
    }
    refuse_without_E0();
  }
  FitResult result;
  result.kind = FitKind::kCreep;
  fill_result(
      model, fit,
      [&](const SpectralState& state) {
        return series_from_creep(model, state, options.is_liquid);
      },
      result);
  fit_laws(model, fit, result);
  result.fit_from_s = time_s.front();
  result.fit_to_s = time_s.back();
  const TestWindow window{shortest_step_s(time_s), 0.0, time_s.front(), time_s.back()};
  add_identifiability_flags(model, fit.state, fit.covariance, window, result);
  report_first_modulus(time_s.front(), result);
  examine_table(model, fit, 0.0, result);
  if (options.with_curves) fill_step_curves(model, fit, "1/Pa", result);
  if (options.keep_rows) {
    KeptRows kept{.shape = KeptRows::Shape::kCreep, .window = window};
    kept.at.assign(time_s.begin(), time_s.end());
    kept.value.assign(compliance_1_Pa.begin(), compliance_1_Pa.end());
    keep(std::move(kept), fit, result);
  }
  note_weights(model, noise, "1/Pa", result);
  return result;
}

FitResult fit_stress_history_as(const HistoryInput& input, const FitOptions& options) {
  const double zero_s = input.step_s.value_or(input.time_s[input.contact]);
  const HistoryModel model(input, options);
  const SpectralFit fit =
      fit_spectrum(model, log_time_blocks(model.row_time_s(), zero_s, 1), options);
  if (!(fit.state.coefficients[0] > 0.0)) refuse_without_E0();
  FitResult result;
  result.kind = FitKind::kCreep;
  fill_result(
      model, fit,
      [&](const SpectralState& state) {
        return series_from_creep(model, state, options.is_liquid);
      },
      result);
  fit_laws(model, fit, result);
  result.fit_from_s = input.time_s.front();
  result.fit_to_s = input.time_s.back();
  const TestWindow window{shortest_step_s(input.time_s), 0.0, 0.0, input.time_s.back() - zero_s};
  add_identifiability_flags(model, fit.state, fit.covariance, window, result);
  report_first_modulus(input.step_s ? input.time_s.front() - *input.step_s : window.sampling_s,
                       result);
  examine_table(model, fit, zero_s, result);
  if (options.with_curves) {
    std::vector<double> starts_s{zero_s};
    for (std::size_t i = 1; i < input.time_s.size(); ++i) {
      const bool begins = input.has_moved[i] && !input.has_moved[i - 1];
      if (begins && input.time_s[i - 1] > starts_s.back()) starts_s.push_back(input.time_s[i - 1]);
    }
    constexpr std::size_t kMostShown = 3;
    if (starts_s.size() > kMostShown) starts_s.resize(1);
    fill_history_curves(model, fit, "", std::move(starts_s), result);
  }
  return result;
}

// Rows at which the stress has moved: averages do not extend over them.
std::vector<char> moved_rows(const std::vector<double>& stress_Pa) {
  constexpr double kMoved = 0.01;
  double largest = 0.0;
  for (const double stress : stress_Pa) largest = std::max(largest, std::abs(stress));
  std::vector<char> has_moved(stress_Pa.size(), 0);
  for (std::size_t i = 1; i < stress_Pa.size(); ++i) {
    has_moved[i] = std::abs(stress_Pa[i] - stress_Pa[i - 1]) > kMoved * largest ? 1 : 0;
  }
  return has_moved;
}

FitResult fit_stress_history(const CreepData& data, const FitOptions& options) {
  constexpr std::size_t kLeastRows = 6;
  if (options.keep_rows) {
    throw std::runtime_error(
        "creep under a stress that changes cannot be fitted together with other tests; fit it "
        "alone, or choose the rows of one constant stress with --from and --to");
  }
  const std::optional<TimeRounding> rounding = time_rounding(data.time_s, data.n_missing);
  const bool is_spread = rounding && !rounding->time_s.empty();
  CheckedRecord record(
      {is_spread ? rounding->time_s : data.time_s, data.compliance_1_Pa, data.stress_Pa},
      kLeastRows, RecordKind::kHistory);
  CleanViews& clean = record.clean;
  const std::vector<std::size_t> spikes = isolated_spikes(clean.steps(), clean.column(1));
  clean.drop(spikes);
  const auto copy_of = [&](std::size_t column) {
    const auto values = clean.column(column);
    return std::vector<double>(values.begin(), values.end());
  };
  if (!data.is_zero_known && begins_under_load(clean.column(2).front(), clean.column(2)))
    check_clock(clean, record.notes, kLatestStep);
  HistoryInput input;
  const auto fit_rows = [&] {
    input = HistoryInput{};
    input.is_creep = true;
    input.time_s = copy_of(0);
    input.output = copy_of(1);
    input.input = copy_of(2);
    while (input.contact + 1 < input.input.size() && input.input[input.contact + 1] == 0.0) {
      ++input.contact;
    }
    if (input.contact + 1 == input.input.size() && input.input.front() == 0.0) {
      throw std::runtime_error(
          "the stress is zero in every row: no stress was applied, or the column is not the "
          "stress");
    }
    input.step_s = step_before(input.time_s, input.input);
    input.has_moved = moved_rows(input.input);
    FitResult found = fit_solid_or_liquid(
        options, [&](const FitOptions& as) { return fit_stress_history_as(input, as); });
    flag_step_before(input.step_s, input.time_s.front(), found);
    return found;
  };
  FitResult result = fit_from_begin(record, fit_rows);
  add_left_out(result, left_out::kNotANumber, clean.n_left_out());
  add_record_notes(record.notes, result);
  add_spikes(result, spikes.size());
  if (rounding) report_time_rounding(*rounding, result);
  if (const double jump_s = sharpest_jump_s(input); jump_s > 0.0)
    report_jump("stress", jump_s, result);
  return result;
}

}  // namespace

FitResult fit_creep(const CreepData& data, const FitOptions& options) {
  constexpr std::size_t kLeastRows = 4;
  if (!options.constraints.empty()) {
    throw std::runtime_error(
        "moduli and times of creep follow from its retardation spectrum and cannot be constrained");
  }
  if (options.allow_negative) {
    throw std::invalid_argument(
        "creep terms cannot be negative: the compliance of a solid only increases");
  }
  if (!data.stress_Pa.empty()) {
    FitResult result = fit_stress_history(data, options);
    flag_left_out(result);
    flag_lack_of_fit({.unit = "strain"}, result);
    keep_intervals_positive(options, result);
    return result;
  }
  const std::optional<TimeRounding> rounding = time_rounding(data.time_s, data.n_missing);
  const bool is_spread = rounding && !rounding->time_s.empty();
  CheckedRecord record({is_spread ? rounding->time_s : data.time_s, data.compliance_1_Pa},
                       kLeastRows, RecordKind::kCreep);
  CleanViews& clean = record.clean;
  if (clean.column(0).front() < 0.0) {
    throw std::runtime_error("the first time is " + text_of(clean.column(0).front()) +
                             " s; t = 0 must be the step of stress (set it with --time-zero)");
  }
  if (!data.is_zero_known) check_clock(clean, record.notes);
  const EndRows ends = drop_end_rows(clean, StepRecord::kCreep);
  const std::vector<std::size_t> spikes = isolated_spikes(clean.steps(), clean.column(1));
  clean.drop(spikes);
  if (!(clean.column(0).back() > clean.column(0).front())) {
    throw std::runtime_error("all rows have the same time, so no creep can be fitted");
  }
  check_sign(clean.column(1), "a creep compliance", "compliance_1_Pa");
  FitResult result = fit_from_begin(record, [&] {
    return fit_solid_or_liquid(options, [&](const FitOptions& as) {
      return fit_creep_as(clean.column(0), clean.column(1), as);
    });
  });
  add_left_out(result, left_out::kNotANumber, clean.n_left_out());
  add_record_notes(record.notes, result);
  add_spikes(result, spikes.size());
  add_end_rows(result, ends, "1/Pa");
  if (rounding) report_time_rounding(*rounding, result);
  if (data.zero_unsure_s > 0.0) widen_for_zero(data.zero_unsure_s, result);
  flag_left_out(result);
  flag_lack_of_fit({.unit = "1/Pa"}, result);
  keep_intervals_positive(options, result);
  return result;
}

}  // namespace viscard
