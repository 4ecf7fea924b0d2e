#include "io/flow/fit_file.h"

#include "fit/fit_creep.h"
#include "fit/fit_dma.h"
#include "fit/fit_indentation.h"
#include "fit/fit_relaxation.h"
#include "fit/indentation_from_capture.h"
#include "fit/laws/law_fit.h"
#include "io/capture/capture_file.h"
#include "io/capture/capture_header.h"
#include "io/tables/csv_table.h"

#include <algorithm>
#include <stdexcept>

namespace viscard {
namespace {

using Column = std::vector<double>;

FitKind kind_of_table(const CsvTable& table, const FitRequest& request) {
  if (request.kind) return *request.kind;
  const auto has = [&](const char* name) {
    return find_column(table, name, request.columns).has_value();
  };
  if (has("force_N") && has("depth_m")) return FitKind::kIndentation;
  if (has("modulus_Pa") || has("stress_Pa")) return FitKind::kRelaxation;
  if (has("compliance_1_Pa")) return FitKind::kCreep;
  if (has("storage_modulus_Pa") && has("loss_modulus_Pa")) return FitKind::kDma;
  throw std::runtime_error(
      table.file +
      ": no known column to fit; expected force_N with depth_m, modulus_Pa, stress_Pa, "
      "compliance_1_Pa, or storage_modulus_Pa with loss_modulus_Pa. Name a column with --column "
      "modulus_Pa=\"HEADER\", or with its number from 1");
}

// Segments of the exported table of a capture from its first baseline on; empty for any other
// table. Before that the rig searches the surface, and its touch is an indentation of its own.
std::vector<std::string> segments_of_test(const CsvTable& table, const FitRequest& request) {
  if (!find_column(table, "segment", request.columns)) return {};
  const std::vector<std::string> rows = column_text(table, "segment", request.columns);
  const auto baseline = std::find(rows.begin(), rows.end(), "baseline");
  if (baseline == rows.end() || std::find(rows.begin(), baseline, "tare") == baseline) return {};
  std::vector<std::string> names;
  for (auto row = baseline; row != rows.end(); ++row) {
    if (std::find(names.begin(), names.end(), *row) == names.end()) names.push_back(*row);
  }
  return names;
}

// The rows of the chosen segments, in the order of the file.
CsvTable rows_of_segments(const CsvTable& table, const FitRequest& request) {
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
    all.lines.insert(all.lines.end(), parts[p].lines.begin(), parts[p].lines.end());
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

Column time_of(const CsvTable& table, const FitRequest& request) {
  Column time_s = column_SI(table, "time_s", request.columns);
  for (double& time : time_s) time -= request.time_zero_s;
  return time_s;
}

FitResult fit_relaxation_table(const CsvTable& table, const FitRequest& request) {
  RelaxationData data;
  data.time_s = time_of(table, request);
  const bool has_modulus = find_column(table, "modulus_Pa", request.columns).has_value();
  data.value = column_SI(table, has_modulus ? "modulus_Pa" : "stress_Pa", request.columns);
  if (!has_modulus && find_column(table, "strain", request.columns)) {
    data.strain = column_SI(table, "strain", request.columns);
  }
  return fit_relaxation(data, request.options);
}

FitResult fit_indentation_table(const CsvTable& table, const FitRequest& request) {
  if (request.needs_modulus && !request.specimen) {
    throw std::runtime_error(
        "--out writes moduli, but an indentation without punch geometry gives only stiffnesses; "
        "add --specimen FILE, or --punch-diameter (and --layer-thickness)");
  }
  IndentationData data;
  data.time_s = time_of(table, request);
  data.force_N = column_SI(table, "force_N", request.columns);
  data.depth_m = column_SI(table, "depth_m", request.columns);
  data.frame_stiffness_N_m = request.frame_stiffness_N_m;
  if (request.specimen) data.contact = request.specimen->contact;
  return fit_indentation(data, request.options);
}

// Fits a master curve if a table of relaxation moduli or frequency sweeps has several temperatures.
std::optional<MasterCurve> fit_temperatures(const CsvTable& table, FitKind kind,
                                            const FitRequest& request) {
  const bool is_step =
      kind == FitKind::kRelaxation && find_column(table, "modulus_Pa", request.columns);
  const bool has_temperature = find_column(table, "temperature_C", request.columns).has_value();
  const bool may_have_several = is_step || kind == FitKind::kDma;
  MasterData data;
  if (has_temperature && may_have_several) {
    data.temperature_C = column_SI(table, "temperature_C", request.columns);
  }
  if (!may_have_several || !has_several_temperatures(data.temperature_C)) {
    if (!request.T_ref_C) return std::nullopt;
    throw std::runtime_error(
        "--reference-temperature applies only to tables of modulus_Pa, or of storage and loss "
        "moduli, with several temperatures in a column temperature_C; omit it");
  }
  if (is_step) {
    data.argument = time_of(table, request);
    data.modulus_Pa = column_SI(table, "modulus_Pa", request.columns);
  } else {
    data.argument = column_SI(table, "frequency_Hz", request.columns);
    data.modulus_Pa = column_SI(table, "storage_modulus_Pa", request.columns);
    data.loss_Pa = column_SI(table, "loss_modulus_Pa", request.columns);
  }
  data.T_ref_C = request.T_ref_C;
  return fit_master_curve(data, request.options);
}

FittedFile fit_table(const std::string& path, const FitRequest& request) {
  const CsvTable all = read_csv(path);
  const CsvTable table = rows_of_segments(all, request);
  FittedFile fitted;
  if (request.segments.empty()) fitted.n_before_test = all.lines.size() - table.lines.size();
  if (request.specimen) fitted.specimen = *request.specimen;
  fitted.specimen_id = specimen_id_of(table, request);
  const FitKind kind = kind_of_table(table, request);
  fitted.master = fit_temperatures(table, kind, request);
  // Of an exported capture; tables of several temperatures make a master curve instead.
  if (kind == FitKind::kIndentation && find_column(table, "temperature_C", request.columns)) {
    fitted.temperature =
        run_temperature(column_with_gaps_SI(table, "temperature_C", request.columns));
  }
  if (fitted.master) {
    fitted.result = fitted.master->fit;
    fitted.fitted_unit = "Pa";
    return fitted;
  }
  switch (kind) {
    case FitKind::kIndentation:
      fitted.result = fit_indentation_table(table, request);
      fitted.fitted_unit = "N";
      break;
    case FitKind::kRelaxation:
      fitted.result = fit_relaxation_table(table, request);
      fitted.fitted_unit = "Pa";
      break;
    case FitKind::kCreep:
      fitted.result =
          fit_creep({time_of(table, request), column_SI(table, "compliance_1_Pa", request.columns)},
                    request.options);
      fitted.fitted_unit = "1/Pa";
      break;
    case FitKind::kDma:
      fitted.result = fit_dma({column_SI(table, "frequency_Hz", request.columns),
                               column_SI(table, "storage_modulus_Pa", request.columns),
                               column_SI(table, "loss_modulus_Pa", request.columns)},
                              request.options);
      fitted.fitted_unit = "Pa";
      break;
  }
  return fitted;
}

// The run has reported a drift already, unless it was killed.
void add_temperature(const CapturedRun& run, FittedFile& fitted) {
  fitted.temperature = run_temperature(run.temperatures);
  if (!fitted.temperature) return;
  const std::string drift =
      temperature_drift_text(*fitted.temperature, run.rig.thermometer.drift_limit_K);
  std::vector<MaterialFlag>& flags = fitted.result.flags;
  const bool is_said = std::any_of(flags.begin(), flags.end(), [](const MaterialFlag& flag) {
    return flag.name == "temperature-drift";
  });
  if (!drift.empty() && !is_said) flags.push_back({"temperature-drift", 0, drift});
}

FittedFile fit_capture(const std::string& path, const FitRequest& request) {
  if (request.kind && *request.kind != FitKind::kIndentation) {
    throw std::runtime_error(path + ": a capture is an indentation; omit --kind");
  }
  if (!request.columns.empty() || !request.segments.empty() || request.time_zero_s != 0.0) {
    throw std::runtime_error(
        path +
        ": --column, --segment and --time-zero apply only to tables; omit them for a capture");
  }
  CapturedRun run = read_capture(path);
  const std::string specimen_id = run.specimen.id;  // the geometry may be replaced, not this
  if (request.specimen) run.specimen = *request.specimen;
  if (request.frame_stiffness_N_m > 0.0) run.rig.frame.stiffness_N_m = request.frame_stiffness_N_m;
  FittedFile fitted;
  fitted.specimen = run.specimen;
  fitted.specimen_id = specimen_id;
  fitted.fitted_unit = "N";
  fitted.result = fit_indentation(indentation_from_capture(run), request.options);
  if (run.status != "finished") {
    fitted.result.flags.push_back(
        {"run-" + run.status, 0,
         "the run was not finished; the fit uses the part that was recorded"});
  }
  // Defects that the run reported about its own record.
  for (const RunEvent& event : run.events) {
    if (event.name != "doubt") continue;
    std::string name = event.value;
    std::replace(name.begin(), name.end(), '_', '-');
    fitted.result.flags.push_back({name, 0, event.text});
  }
  add_temperature(run, fitted);
  return fitted;
}

// Answers with the law that was asked for.
void take_laws(const FitRequest& request, bool is_capture, FittedFile& fitted) {
  if (!request.diagnose && request.model.empty()) return;
  if (fitted.result.laws.empty()) {
    throw std::runtime_error(
        std::string(request.model.empty() ? "--diagnose compares" : "--model fits") +
        " laws in tables of relaxation, creep, oscillation and indentation at one temperature; " +
        (is_capture ? "write this capture as a table first (viscard export), and fit that"
                    : "these data are of another kind, so omit it"));
  }
  if (request.model.empty()) return;
  take_law(request.model, fitted.result);
  fitted.model = request.model;
}

}  // namespace

FittedFile fit_file(const std::string& path, const FitRequest& request) {
  const bool is_capture = looks_like_capture(path);
  // Readers name the file in their messages; the fit does not know it.
  try {
    FitRequest wanted = request;
    wanted.options.with_laws = request.diagnose || !request.model.empty();
    FittedFile fitted = is_capture ? fit_capture(path, wanted) : fit_table(path, wanted);
    fitted.path = path;
    if (request.diagnose) fitted.fractional = diagnose_fractional(fitted.result);
    take_laws(request, is_capture, fitted);
    return fitted;
  } catch (const std::exception& error) {
    const std::string text = error.what();
    if (text.find(path) != std::string::npos) throw;
    throw std::runtime_error(path + ": " + text);
  }
}

}  // namespace viscard
