#include "fit/fit_indentation.h"

#include "fit/assembly/assemble_result.h"
#include "fit/assembly/bench_doubt.h"
#include "fit/assembly/solid_or_liquid.h"
#include "fit/assembly/table_drift.h"
#include "fit/assembly/two_point_modulus.h"
#include "fit/contact_fit.h"
#include "fit/contact_table.h"
#include "fit/curves/history_model.h"
#include "fit/intervals/flags.h"
#include "fit/intervals/kept_rows.h"
#include "fit/intervals/left_out.h"
#include "fit/intervals/positive_intervals.h"
#include "fit/intervals/time_rounding.h"
#include "fit/laws/law_fit.h"
#include "fit/samples/check_record.h"
#include "fit/samples/chosen_rows.h"
#include "fit/samples/clean_data.h"
#include "fit/samples/contact_onset.h"
#include "fit/samples/noise_model.h"
#include "fit/samples/rounded_times.h"
#include "fit/search/separable.h"
#include "models/material/systematic_parts.h"
#include "models/maths/text_of_number.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>

namespace viscard {
namespace {

using Index = Eigen::Index;
using Column = std::vector<double>;

// Saturation is a long run of samples equal to the largest: the end of the converter's range.
void flag_saturation(const Column& force_N, FitResult& result) {
  const double top = *std::max_element(force_N.begin(), force_N.end());
  std::size_t run = 0;
  std::size_t longest = 0;
  for (const double force : force_N) {
    run = force == top ? run + 1 : 0;
    longest = std::max(longest, run);
  }
  constexpr std::size_t kSuspicious = 5;
  if (longest >= kSuspicious) {
    add_defect(result, "saturated",
               std::to_string(longest) + " samples in a row stand exactly at the largest force (" +
                   text_of(top) +
                   " N): the load cell or its converter reached the end of its range");
  }
}

void flag_gap(const Column& time_s, std::size_t contact, std::size_t loaded, FitResult& result) {
  if (time_s.size() < contact + 1 + kLeastContactRows || loaded <= contact) return;
  // Rows that share a rounded time are no closer than its step.
  const double usual_s = std::max(usual_step_s({time_s.data() + contact, time_s.size() - contact}),
                                  rounding_step_s(time_s).value_or(0.0));
  const double ramp_s = time_s[loaded] - time_s[contact];
  for (std::size_t i = contact + 1; i <= loaded; ++i) {
    const double step_s = time_s[i] - time_s[i - 1];
    if (step_s <= 3.5 * usual_s || step_s < 0.1 * ramp_s) continue;
    add_defect(result, "gap-in-ramp",
               "no samples for " + text_of(step_s) + " s from t = " + text_of(time_s[i - 1]) +
                   " s on, while the load rose: the depth in between is unknown");
    return;
  }
}

void flag_table_misfit(const HistoryInput& input, const TableContact& contact, FitResult& result) {
  if (!contact.is_fitted) return;
  const auto first = static_cast<std::ptrdiff_t>(contact.first);
  const Column quiet_N(input.output.begin(), input.output.begin() + first);
  const auto [low, high] = std::minmax_element(input.output.begin(), input.output.end());
  flag_misfit(result.noise.sigma, sigma_from_differences(quiet_N), quiet_N.size(), *high - *low,
              result);
}

// The two-point modulus of the loading part.
std::optional<TwoPointModulus> two_points(const HistoryInput& input, std::size_t first,
                                          std::size_t end, const PunchContact& contact,
                                          const FitResult& result) {
  const auto slice = [&](const Column& column) {
    return Column(column.begin() + static_cast<std::ptrdiff_t>(first),
                  column.begin() + static_cast<std::ptrdiff_t>(end) + 1);
  };
  Column depth_m = slice(input.input);
  for (double& depth : depth_m) depth -= result.contact_position_m.value_or(0.0);
  return two_point_modulus(slice(input.time_s), slice(input.output), depth_m, contact,
                           result.noise.sigma);
}

// Of several ramps with holds between them, all ramps together.
double ramps_s(const ContactTable& table, const HistoryInput& input) {
  const std::size_t last = input.time_s.size() - 1;
  return moving_s(input.time_s, input.input, std::min(table.contact.first, last),
                  std::min(table.loaded, last));
}

TestWindow window_of(const ContactTable& table, const HistoryInput& input) {
  const std::size_t last = input.time_s.size() - 1;
  const double zero_s = input.time_s[std::min(table.contact.first, last)];
  return {shortest_step_s(input.time_s), ramps_s(table, input), 0.0, input.time_s.back() - zero_s};
}

// Fills window, flags and the two-point modulus.
void report_table(const IndentationData& data, const ContactTable& table, const HistoryInput& input,
                  const HistoryModel& model, const SpectralFit& fit, FitResult& result) {
  const TableContact& contact = table.contact;
  result.fit_from_s = input.time_s.front();
  result.fit_to_s = input.time_s.back();
  if (contact.is_fitted) result.contact_position_m = fit.state.nuisance[0];
  const std::size_t end = std::min(table.loaded, input.time_s.size() - 1);
  result.fastest_s = ramps_s(table, input);
  add_identifiability_flags(model, fit.state, fit.covariance, window_of(table, input), result);
  flag_saturation(input.output, result);
  flag_table_misfit(input, contact, result);
  flag_gap(input.time_s, contact.first, end, result);
  if (table.law.power != 1.0 && input.time_s.size() < table.time_s.size()) {
    result.flags.push_back({"unloading-left-out", 0,
                            "samples after the depth began to fall were left out: the formula for "
                            "a sphere or cone holds while the contact does not shrink"});
  }
  if (data.contact && table.law.power == 1.0 && end > contact.first) {
    result.two_point = two_points(input, contact.first, end, *data.contact, result);
  }
}

// Rows that the fit does not use.
void count_left_out(const ContactTable& table, const HistoryFit& fitted, FitResult& result) {
  add_left_out(result, left_out::kNotANumber, table.n_not_a_number);
  add_record_notes(table.notes, result);
  add_spikes(result, table.n_spikes);
  add_left_out(result, left_out::kDepthSpike, table.n_depth_spikes);
  add_left_out(result, left_out::kEarlierTouch, table.n_touch);
  add_left_out(result, left_out::kAdhesion, fitted.n_adhesion);
  const std::size_t rest = table.time_s.size() - fitted.input.time_s.size() - fitted.n_adhesion;
  add_left_out(result, table.law.power == 1.0 ? left_out::kContactLost : left_out::kUnloading,
               rest);
  result.n_contacts = fitted.n_contacts;
}

// The fit of a table after preparation, with or without a drift of the force.
FitResult fit_contact_table(const IndentationData& data, const ContactTable& table, bool with_drift,
                            const FitOptions& options) {
  HistoryInput input = first_contact(table);
  input.with_drift = with_drift;
  if (!input.contact_input && input.contact == 0 && !table.goes_back) {
    input.step_s = step_before(input.time_s, input.input);
  }
  HistoryFit fitted = fit_history(std::move(input), options);
  if (table.goes_back || !table.touch_m.empty())
    fitted = fit_whole(table, std::move(fitted), options);
  const HistoryModel& model = *fitted.model;
  FitResult result;
  result.is_stiffness = !data.contact;
  fill_result(model, fitted.fit, relaxation_series_of(model, options.is_liquid), result);
  fit_laws(model, fitted.fit, result);
  count_left_out(table, fitted, result);
  report_table(data, table, fitted.input, model, fitted.fit, result);
  flag_step_before(fitted.input.step_s, fitted.input.time_s.front(), result);
  examine_table(model, fitted.fit, fitted.zero_s(), result);
  const std::vector<double>& time_s = fitted.input.time_s;
  const auto& step_s = fitted.input.step_s;
  report_first_modulus(step_s ? time_s.front() - *step_s : shortest_step_s(time_s), result);
  if (options.with_curves) {
    fill_history_curves(model, fitted.fit, "N", {}, result);
  }
  if (options.keep_rows) {
    KeptRows kept{.shape = KeptRows::Shape::kHistory, .zero_s = fitted.zero_s()};
    kept.window = window_of(table, fitted.input);
    kept.history = std::move(fitted.input);
    keep(std::move(kept), fitted.fit, result);
  }
  return result;
}

FitResult fit_measured_depth(const IndentationData& data, const FitOptions& options) {
  const ContactTable table = contact_table(data);
  const HistoryInput input = first_contact(table);
  if (input.time_s.size() < kLeastContactRows) {
    throw std::runtime_error("only " + counted(input.time_s.size(), "sample") +
                             " between contact and its loss; a fit needs at least " +
                             std::to_string(kLeastContactRows));
  }
  const auto [low, high] = std::minmax_element(input.output.begin(), input.output.end());
  FitResult result = fit_with_or_without_drift(
      options, {input.time_s.back() - input.time_s.front(), *high - *low, "N"},
      [&](TableDrift drift) {
        return fit_solid_or_liquid(options, [&](const FitOptions& as) {
          return fit_contact_table(data, table, drift == TableDrift::kFitted, as);
        });
      });
  if (const double jump_s = sharpest_jump_s(input); jump_s > 0.0)
    report_jump("depth", jump_s, result);
  return result;
}

// The first row in time has the punch in the specimen already, and its time is not 0.
bool begins_late_under_load(const IndentationData& data) {
  std::size_t first = data.time_s.size();
  for (std::size_t i = 0; i < data.time_s.size() && i < data.depth_m.size(); ++i) {
    if (!std::isfinite(data.time_s[i]) || !std::isfinite(data.depth_m[i])) continue;
    if (first == data.time_s.size() || data.time_s[i] < data.time_s[first]) first = i;
  }
  if (data.is_zero_known || first == data.time_s.size() || !(data.time_s[first] > 0.0))
    return false;
  return begins_under_load(data.depth_m[first], data.depth_m);
}

// A table, the times of which its export may have rounded, and may count from long before the load.
FitResult fit_depth_table(const IndentationData& data, const FitOptions& options) {
  const std::optional<TimeRounding> rounding = time_rounding(data.time_s, data.n_missing);
  const bool is_spread = rounding && !rounding->time_s.empty();
  std::optional<IndentationData> changed;  // with other rows or times
  if (is_spread) {
    changed = data;
    changed->time_s = rounding->time_s;
  }
  FitResult result;
  if (begins_late_under_load(changed ? *changed : data)) {
    if (!changed) changed = data;
    CheckedRecord record({changed->time_s, changed->force_N, changed->depth_m}, kLeastContactRows,
                         RecordKind::kHistory);
    check_clock(record.clean, record.notes, kLatestStep);
    result = fit_from_begin(record, [&] {
      const auto column = [&](std::size_t i) {
        const auto values = record.clean.column(i);
        return std::vector<double>(values.begin(), values.end());
      };
      IndentationData rows = *changed;
      rows.time_s = column(0);
      rows.force_N = column(1);
      rows.depth_m = column(2);
      return fit_measured_depth(rows, options);
    });
    add_left_out(result, left_out::kNotANumber, record.clean.n_left_out());
    add_record_notes(record.notes, result);
  } else {
    result = fit_measured_depth(changed ? *changed : data, options);
  }
  if (rounding) report_time_rounding(*rounding, result);
  return result;
}

// Stated uncertainties of frame, load cell and geometry, and their effect on the result.
void add_systematic_parts_to(const IndentationData& data, FitResult& result) {
  BenchDoubt doubt{.frame_stiffness_N_m = data.frame_stiffness_N_m,
                   .frame_relative_u = data.frame_stiffness_relative_u,
                   .force_relative_u = data.force_relative_u,
                   .depth_relative_u = data.depth_relative_u};
  if (data.contact) doubt.geometry_relative_u = relative_uncertainty(*data.contact);
  const DepthLaw law = data.contact ? depth_law(*data.contact) : DepthLaw{1.0, 1.0};
  // Stiffness of the contact divided by the modulus, at the largest depth.
  const double depth_m =
      law.power == 1.0 ? 1.0 : *std::max_element(data.depth_m.begin(), data.depth_m.end());
  const double factor_m = law.power * law.factor * std::pow(depth_m, law.power - 1.0);
  PronySeries stiffness_N_m{factor_m * result.E_inf_Pa, {}};
  for (const FittedTerm& term : result.terms) {
    stiffness_N_m.terms.push_back({factor_m * term.modulus_Pa, term.tau_s});
  }
  result.systematic_parts = systematic_parts_from(stiffness_N_m, doubt);
  result.systematic_relative = systematic_u_of_E0(result.systematic_parts);
}

}  // namespace

void flag_readings(const IndentationData& data, FitResult& result) {
  if (!data.force_doubt.empty())
    result.flags.push_back({"beyond-calibration", 0, data.force_doubt});
  if (!data.approach_doubt.empty()) {
    result.flags.push_back({"touch-unknown", 0,
                            data.approach_doubt +
                                ": what the touch of the approach has left in the specimen is "
                                "not known, and g may lie low for terms that are not fast "
                                "beside the baseline. Repeat the run with viscard capture"});
  }
  if (data.n_saturated > 0) {
    add_defect(
        result, "saturated",
        counted(data.n_saturated, "reading") + " at the end of the converter's range left out");
  }
}

FitResult fit_indentation(const IndentationData& data, const FitOptions& options) {
  if (!data.moves.empty() && data.contact && data.contact->shape != TipShape::kFlat) {
    throw std::runtime_error(
        "captured runs are fitted for a flat punch only; export the run (viscard export) and fit "
        "its table of force and depth for a sphere or cone");
  }
  FitResult result =
      data.moves.empty() ? fit_depth_table(data, options) : fit_stage_indentation(data, options);
  result.kind = FitKind::kIndentation;
  add_systematic_parts_to(data, result);
  add_left_out(result, left_out::kSaturated, data.n_saturated);
  add_left_out(result, left_out::kGlitch, data.n_glitch);
  flag_left_out(result);
  flag_readings(data, result);
  keep_intervals_positive(options, result);
  return result;
}

}  // namespace viscard
