#include "io/flow/fit_table.h"

#include "fit/intervals/left_out.h"
#include "fit/master_segments.h"
#include "io/basics/words.h"
#include "io/flow/damaged_table.h"
#include "io/flow/fit_of_kind.h"
#include "io/flow/plausible_record.h"
#include "io/flow/table_kind.h"
#include "io/tables/csv_table.h"
#include "io/tables/modulus_of_columns.h"
#include "models/maths/text_of_number.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace viscard {
namespace {

constexpr const char* kHomingSegment = "home";  // after the lift at the end of a run

// Segments of the exported table of a capture from its first baseline on; empty for any other
// table. Before that the rig searches the surface, and its touch is an indentation of its own; after
// the test it may be homed, which shakes the load cell.
std::vector<std::string> segments_of_test(const CsvTable& table, const FitRequest& request) {
  if (!find_column(table, "segment", request.columns)) return {};
  const std::vector<std::string> rows = column_text(table, "segment", request.columns);
  const auto baseline = std::find(rows.begin(), rows.end(), "baseline");
  if (baseline == rows.end() || std::find(rows.begin(), baseline, "tare") == baseline) return {};
  std::vector<std::string> names;
  for (auto row = baseline; row != rows.end(); ++row) {
    if (*row == kHomingSegment) continue;
    if (std::find(names.begin(), names.end(), *row) == names.end()) names.push_back(*row);
  }
  return names;
}

// Rows of force and depth before the test, which the specimen remembers.
ForceDepthRows rows_before_test(const CsvTable& table, const FitRequest& request) {
  ForceDepthRows rows;
  for (const char* name : {"time_s", "force_N", "depth_m"}) {
    if (!find_column(table, name, request.columns)) return rows;
  }
  if (!request.segments.empty() || segments_of_test(table, request).empty()) return rows;
  const std::vector<std::string> segments = column_text(table, "segment", request.columns);
  const auto n = std::find(segments.begin(), segments.end(), "baseline") - segments.begin();
  const auto first_rows = [&](const char* name) {
    const std::vector<double> all = column_with_gaps_SI(table, name, request.columns);
    return std::vector<double>(all.begin(), all.begin() + n);
  };
  rows.time_s = first_rows("time_s");
  rows.force_N = first_rows("force_N");
  rows.depth_m = first_rows("depth_m");
  return rows;
}

// Rows of an exported capture in which the stage is homed after the test.
std::size_t count_after_test(const CsvTable& table, const FitRequest& request) {
  if (!request.segments.empty() || segments_of_test(table, request).empty()) return 0;
  const std::vector<std::string> rows = column_text(table, "segment", request.columns);
  const auto baseline = std::find(rows.begin(), rows.end(), "baseline");
  return static_cast<std::size_t>(std::count(baseline, rows.end(), kHomingSegment));
}

// The rows of the chosen segments, in the order of the file.
CsvTable rows_of_segments(CsvTable table, const FitRequest& request) {
  const std::vector<std::string> segments =
      request.segments.empty() ? segments_of_test(table, request) : request.segments;
  if (segments.empty()) return table;
  std::vector<CsvTable> parts;
  for (const std::string& segment : segments) {
    parts.push_back(rows_of_segment(table, segment, request.columns));
  }
  std::stable_sort(parts.begin(), parts.end(), [](const CsvTable& a, const CsvTable& b) {
    return !a.lines.empty() && !b.lines.empty() && a.lines.front() < b.lines.front();
  });
  CsvTable all = parts.front();
  for (std::size_t p = 1; p < parts.size(); ++p) {
    for (const std::uint32_t line : parts[p].lines.all()) all.lines.push_back(line);
    for (std::size_t c = 0; c < all.columns.size(); ++c) {
      CsvColumn& to = all.columns[c];
      const CsvColumn& from = parts[p].columns[c];
      to.values.insert(to.values.end(), from.values.begin(), from.values.end());
      to.text.insert(to.text.end(), from.text.begin(), from.text.end());
    }
  }
  return all;
}

// The specimen that the table states in a column; empty without one.
std::string specimen_id_of(const CsvTable& table, const FitRequest& request) {
  if (!find_column(table, "specimen", request.columns)) return "";
  const std::vector<std::string> ids = column_text(table, "specimen", request.columns);
  for (const std::string& id : ids) {
    if (id == ids.front()) continue;
    if (!request.needs_specimen) return "";
    throw std::runtime_error(table.file + ": the column specimen names '" + ids.front() +
                             "' and '" + id +
                             "', but a table holds one record of one specimen; divide the table");
  }
  return ids.empty() ? "" : ids.front();
}

// Parts of a maker's file whose clocks begin anew belong to different tests.
void refuse_several_parts(const CsvTable& table, FitKind kind, const FitRequest& request) {
  const bool has_parts = !table.maker.empty() && request.segments.empty() &&
                         find_column(table, "segment", request.columns);
  if (!has_parts || kind == FitKind::kDma) return;
  const std::vector<std::string> parts = column_text(table, "segment", request.columns);
  const std::vector<double> time_s = column_with_gaps_SI(table, "time_s", request.columns);
  std::vector<std::string> names{parts.front()};
  bool restarts = false;
  for (std::size_t i = 1; i < parts.size(); ++i) {
    if (parts[i] == parts[i - 1]) continue;
    names.push_back(parts[i]);
    restarts = restarts || !(time_s[i] > time_s[i - 1]);
  }
  if (!restarts) return;
  throw std::runtime_error(table.file + ": holds " + std::to_string(names.size()) +
                           " parts, each with its own time or columns: " + listed(names) +
                           ". Choose one with --segment " + quoted_for_shell({names.back()}));
}

// The options that name times, and whether they have an effect on this kind.
OptionUses uses_of_times(FitKind kind, const FitRequest& request) {
  const bool has_effect = kind != FitKind::kDma;
  const std::string of = "records in time, and there are frequencies alone";
  return {{"--time-zero", request.time_zero_s.has_value(), has_effect, of},
          {"--from", request.from_s.has_value(), has_effect, of},
          {"--to", request.to_s.has_value(), has_effect, of},
          {"--hold", request.hold > 0, has_effect, of},
          {"--crop", request.crop, has_effect, of}};
}

// The options that need something of a table, and whether they have an effect on this one.
OptionUses uses_on(const CsvTable& table, FitKind kind, const FitRequest& request) {
  const bool is_indentation = kind == FitKind::kIndentation;
  const bool is_alone = kind == FitKind::kRelaxation && is_force_alone(table, request);
  const bool has_shape = request.specimen && request.specimen->id.empty();  // not by --specimen
  const bool has_vertical = request.options.vertical_shift != VerticalShift::kAuto;
  const bool has_start = !request.start_shifts.empty();
  const bool has_master = (request.T_ref_C || has_start || has_vertical) &&
                          master_data(table, kind, request).has_value();
  const std::string of_master =
      "tables of modulus_Pa, or of storage and loss moduli, with several temperatures in a column "
      "temperature_C";
  return {{"--depth", request.depth_m.has_value(), is_alone,
           "a record of force at constant depth, without a column of depth"},
          {"--drift", request.options.drift == TableDrift::kFitted,
           is_indentation || kind == FitKind::kRelaxation,
           "tables of relaxation and indentation: in creep a drift is flow, and in an oscillation "
           "there is none"},
          {"--punch-diameter", has_shape, is_indentation || is_alone,
           "records of force, and there is none that is fitted"},
          {"--frame-stiffness", request.frame_stiffness_N_m > 0.0, is_indentation,
           "tables of force and depth"},
          {"--modulus-kind", request.modulus_kind.has_value(), !is_indentation && !is_alone,
           "tables of moduli, compliances or stresses"},
          {"--reference-temperature", request.T_ref_C.has_value(), has_master, of_master},
          {"--start-shift", has_start, has_master, of_master},
          {"--vertical-shift", has_vertical, has_master, of_master},
          {"--unverified", request.accepts_unverified, is_exported(table),
           "captures, and tables that viscard exported from them"},
          {"--sheet", !request.table.sheet.empty(), true, "tables"},
          {"--table", request.table.table > 0, true, "tables"},
          {"--skip", request.table.skip > 0, true, "tables"}};
}

// Options for the other files do not apply to this one.
FitRequest of_this_file(const CsvTable& table, FitKind kind, const FitRequest& request) {
  FitRequest one = request;
  if (!request.is_beside_others) return one;
  const bool is_alone = kind == FitKind::kRelaxation && is_force_alone(table, request);
  if (!is_alone) one.depth_m.reset();
  if (kind != FitKind::kIndentation) one.frame_stiffness_N_m = 0.0;
  if (kind == FitKind::kIndentation || is_alone) one.modulus_kind.reset();
  if (kind == FitKind::kDma) {
    for (auto* time_s : {&one.time_zero_s, &one.from_s, &one.to_s}) time_s->reset();
    one.hold = 0;
    one.crop = false;
  }
  const bool may_drift = kind == FitKind::kRelaxation || kind == FitKind::kIndentation;
  if (!may_drift) one.options.drift = TableDrift::kNone;
  if (request.is_one_of_several && kind != FitKind::kIndentation && !one.depth_m) {
    one.specimen.reset();
  }
  return one;
}

// What the moduli of a table are, unless it has forces.
std::optional<MeasuredModulus> measured_modulus(const CsvTable& table, FitKind kind,
                                                const FitRequest& request) {
  const bool has_forces = kind == FitKind::kIndentation ||
                          (kind == FitKind::kRelaxation && is_force_alone(table, request));
  if (has_forces) return std::nullopt;
  MeasuredModulus modulus;
  modulus.nu = request.nu.value_or(kUsualNu);
  modulus.is_nu_stated = request.nu.has_value();
  if (request.modulus_kind) {
    modulus.kind = *request.modulus_kind;
    modulus.from = "--modulus-kind";
  } else {
    TableModulusKind found =
        modulus_kind_of(table, request.columns, columns_of_kind(kind, table, request));
    modulus.kind = found.kind;
    modulus.from = std::move(found.from);
    if (found.is_assumed) modulus.assumed_header = std::move(found.header);
  }
  if (modulus.kind == ModulusKind::kBulk && !request.nu) {
    throw std::runtime_error(
        "a bulk modulus gives Young's modulus only with an exact Poisson ratio; state it with "
        "--poisson-ratio");
  }
  return modulus;
}

// Sums of squares, noise and curves in the unit of the column that was fitted.
// factor: by which its values were multiplied.
void show_in_column(double factor, FitResult& result) {
  if (factor == 1.0) return;
  const double squared = factor * factor;
  result.rss /= squared;
  for (OrderRow& row : result.orders) row.rss /= squared;
  for (FittedLaw& law : result.laws) law.rss /= squared;
  if (result.kind != FitKind::kDma) result.noise.sigma /= factor;
  if (result.drift) {
    result.drift->per_s /= factor;
    result.drift->se_per_s /= factor;
  }
  if (result.lack_of_fit) {
    for (double* value : {&result.lack_of_fit->structure, &result.lack_of_fit->noise,
                          &result.lack_of_fit->worst, &result.lack_of_fit->rise}) {
      *value /= factor;
    }
  }
  FitCurves& curves = result.curves;
  for (auto* column : {&curves.measured, &curves.fitted, &curves.sigma, &curves.loss_measured,
                       &curves.loss_fitted, &curves.loss_sigma}) {
    for (double& value : *column) value /= factor;
  }
}

// What a material shall tell about its moduli, and cards and predictions with it: that they were measured in
// another kind of load, or that nothing states the kind, which is asked.
void flag_kind(const MeasuredModulus& modulus, FitResult& result) {
  const ModulusKindText& text = text_of(modulus.kind);
  if (modulus.kind != ModulusKind::kTension) {
    result.flags.push_back(
        {std::string("measured-as-") + text.word, 0,
         "by " + modulus.from + " the moduli are of " + text.word + ": " + text.letter +
             "0 = " + text_with_unit(result.E0_Pa / modulus.young_factor(), "Pa") + ", and " +
             text.conversion + " with a Poisson ratio of " + text_of(modulus.nu) +
             (modulus.is_nu_stated ? "" : ", which is assumed; state --poisson-ratio")});
  }
  if (modulus.assumed_header.empty()) return;
  result.flags.push_back(
      {"modulus-kind-assumed", 0,
       "'" + modulus.assumed_header +
           "' does not state whether it is of tension or of shear, and was taken as of tension; of "
           "shear, E0 would be " +
           text_of(young_over(ModulusKind::kShear, modulus.nu), 3) +
           " times as large. State --modulus-kind tension or --modulus-kind shear"});
}

// Fits the rows of a table that are in the chosen part.
FittedFile fit_rows(const CsvTable& table, const FitRequest& asked) {
  if (asked.is_one_of_several && asked.kind) require_kind(table, *asked.kind, asked);
  const FitKind kind = kind_of_table(table, asked);
  FitRequest request = of_this_file(table, kind, asked);
  FittedFile fitted;
  if (request.specimen) fitted.specimen = *request.specimen;
  fitted.specimen_id = specimen_id_of(table, request);
  refuse_several_parts(table, kind, request);
  fitted.uses = uses_on(table, kind, asked);
  if (!asked.is_beside_others) refuse_idle(fitted.uses);
  fitted.modulus = measured_modulus(table, kind, request);
  if (fitted.modulus) request.young_factor = fitted.modulus->young_factor();
  // Of an exported capture; tables of several temperatures make a master curve instead.
  if (kind == FitKind::kIndentation && find_column(table, "temperature_C", request.columns)) {
    fitted.temperature =
        run_temperature(column_with_gaps_SI(table, "temperature_C", request.columns));
  }
  TableFit fit = fit_of_kind(table, kind, request);
  fitted.result = std::move(fit.result);
  fitted.master = std::move(fit.master);
  fitted.fitted_unit = fit.unit;
  fitted.has_no_depth = fit.has_no_depth;
  return fitted;
}

// What is doubtful about the strains or depths of a test that a linear law shall describe.
std::optional<MaterialFlag> doubtful_size(const CsvTable& table, const FitRequest& request) {
  const FitKind kind = kind_of_table(table, request);
  if (kind == FitKind::kCreep || kind == FitKind::kRelaxation) {
    return strain_flag(table, request.columns, request.plausible);
  }
  // A stage also moves before it touches.
  if (kind != FitKind::kIndentation || request.frame_stiffness_N_m > 0.0) return std::nullopt;
  const auto use = find_column(table, "depth_m", request.columns);
  // An extension in its unit may be long.
  if (!use || (!request.specimen && !use->is_unit_assumed)) return std::nullopt;
  double deepest_m = 0.0;
  for (const double depth_m : column_with_gaps_SI(table, "depth_m", request.columns)) {
    if (std::isfinite(depth_m)) deepest_m = std::max(deepest_m, depth_m);
  }
  const std::string remedy =
      use->is_unit_assumed ? words_for_factor(table, "depth_m", *use, 1e-3) : "";
  refuse_depth(table, deepest_m, request.plausible, remedy);
  if (!request.specimen) return std::nullopt;
  return depth_flag(deepest_m, request.specimen->contact.layer_thickness_m, request.plausible,
                    remedy);
}

}  // namespace

FittedFile fit_table(const std::string& path, const FitRequest& request) {
  return fit_csv(read_csv(path, request.table), request);
}

std::vector<MasterSegment> isotherms_of(CsvTable all, const FitRequest& request) {
  const FitKind kind = kind_of_table(all, request);
  const bool may_have_several = kind == FitKind::kRelaxation || kind == FitKind::kDma;
  if (!may_have_several || !find_column(all, "temperature_C", request.columns)) return {};
  CsvTable table = rows_of_segments(std::move(all), request);
  std::vector<std::string> used = columns_of_kind(kind, table, request);
  used.emplace_back("temperature_C");
  std::size_t n_gaps = 0;
  table = rows_without_gaps(std::move(table), used, request.columns, n_gaps);
  choose_part(table, request);
  const auto data = master_data(table, kind, request);
  return data ? segments_of(*data).segments : std::vector<MasterSegment>{};
}

FittedFile fit_csv(CsvTable all, const FitRequest& asked) {
  const auto [maker, n_all] = std::pair(all.maker, all.lines.size());
  const std::vector<IntegrityNote> damage = accepted_damage(all, asked.accepts_unverified);
  FitRequest request = asked;
  all.judged = request.plausible;
  if (!request.specimen && !request.depth_m) request.size = size_from_notes(all, request.size);
  const OptionUses uses = uses_of(asked.size, derive_columns(all, request.columns, request.size));
  if (!request.is_beside_others) refuse_idle(uses);
  request.before_test = rows_before_test(all, request);
  const std::size_t n_after = count_after_test(all, request);
  CsvTable table = rows_of_segments(std::move(all), request);
  const std::size_t n_in_segments = table.lines.size();
  std::size_t n_gaps = 0;
  const FitKind kind = kind_of_table(table, request);
  std::vector<std::string> used = columns_of_kind(kind, table, request);
  used.emplace_back("temperature_C");
  table = rows_without_gaps(std::move(table), used, request.columns, n_gaps);
  const OptionUses of_times = uses_of_times(kind, request);
  if (!request.is_beside_others) refuse_idle(of_times);
  ChosenPart part = choose_part(table, of_this_file(table, kind, request));
  const auto doubt = doubtful_size(table, request);
  FittedFile fitted = fit_rows(table, part.rise_s ? with_zero_in(*part.rise_s, request) : request);
  add_uses(uses, fitted.uses);
  add_uses(of_times, fitted.uses);
  flag_assumed_units(table, request, fitted.result);
  if (fitted.modulus) {
    flag_kind(*fitted.modulus, fitted.result);
    const double factor = fitted.modulus->young_factor();
    if (!request.options.keep_rows) {
      const bool is_strain = fitted.fitted_unit == kStrainUnit;
      show_in_column(is_strain                               ? 1.0
                     : fitted.result.kind == FitKind::kCreep ? 1.0 / factor
                                                             : factor,
                     fitted.result);
    }
  }
  if (doubt) fitted.result.flags.push_back(*doubt);
  const bool is_modulus = !fitted.result.is_stiffness && !fitted.has_no_depth;
  if (is_modulus) refuse_modulus(fitted.result.E0_Pa, &table, request.columns, request.plausible);
  flag_history(part, fitted.result);
  flag_damage(damage, fitted.result);
  fitted.maker = maker;
  fitted.notes = table.notes;
  fitted.chosen = std::move(part.text);
  add_left_out(fitted.result, left_out::kNotANumber, n_gaps);
  if (n_gaps > 0) {  // the fit knew only the other rows
    std::erase_if(fitted.result.flags, [](const MaterialFlag& flag) {
      return flag.name == "rows-left-out" || flag.name == "rows-lost";
    });
    flag_left_out(fitted.result);
  }
  add_left_out(fitted.result, left_out::kNotChosen, n_in_segments - n_gaps - table.lines.size());
  const std::size_t n_other = n_all - n_in_segments - n_after;
  if (request.segments.empty()) fitted.n_before_test = n_other;
  add_left_out(fitted.result,
               request.segments.empty() ? left_out::kBeforeTest : left_out::kNotChosen, n_other);
  add_left_out(fitted.result, left_out::kAfterTest, n_after);
  return fitted;
}

}  // namespace viscard
