#include "fit/fit_creep.h"

#include "fit/assembly/assemble_result.h"
#include "fit/assembly/solid_or_liquid.h"
#include "fit/assembly/table_drift.h"
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

#include <cmath>
#include <optional>
#include <span>
#include <stdexcept>
#include <utility>

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
    throw std::runtime_error(
        "the record shows no instantaneous compliance (it begins at zero), so E0 would be "
        "infinite. Start the record earlier after the step, or give fewer terms with --terms");
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

}  // namespace

FitResult fit_creep(const CreepData& data, const FitOptions& options) {
  constexpr std::size_t kLeastRows = 4;
  if (!options.constraints.empty()) {
    throw std::runtime_error(
        "moduli and times of creep follow from its retardation spectrum and cannot be constrained");
  }
  const std::optional<TimeRounding> rounding = time_rounding(data.time_s);
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
  if (options.allow_negative) {
    throw std::invalid_argument(
        "creep terms cannot be negative: the compliance of a solid only increases");
  }
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
