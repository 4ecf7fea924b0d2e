#include "io/flow/fit_file.h"

#include "fit/fit_indentation.h"
#include "fit/indentation_from_capture.h"
#include "fit/laws/law_fit.h"
#include "io/capture/capture_file.h"
#include "io/capture/capture_header.h"
#include "io/capture/integrity_notes.h"
#include "io/flow/damaged_table.h"
#include "io/flow/fit_table.h"
#include "io/flow/plausible_record.h"
#include "io/flow/table_from_capture.h"
#include "io/materials/plausible_numbers.h"
#include "models/maths/failure_text.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace viscard {
namespace {

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

// Steps that an open-loop stage has lost are in no interval unless the rig file gives a doubt.
void note_counted_depth(const CapturedRun& run, FittedFile& fitted) {
  bool is_counted = false;
  for (const RunEvent& event : run.events) {
    if (event.name == "depth") is_counted = event.value == "counted";
  }
  if (!is_counted || run.rig.stage.depth_relative_u > 0.0) return;
  fitted.notes.push_back(
      "the depth is counted in steps of the stage, not measured, and depth_relative_u of the rig "
      "file is 0: an error of it is not in the intervals");
}

// In a fit of several tests a captured run is used as its table of force and depth. The depth is
// without the frame's deflection.
FittedFile fit_as_table(const std::string& path, const CapturedRun& run,
                        const FitRequest& request) {
  FitRequest of_table = request;
  of_table.specimen = run.specimen;
  of_table.frame_stiffness_N_m = 0.0;
  CsvTable table = csv_from_text(table_from_capture(run), path);
  table.comments.clear();  // damage that they state is judged by fit_capture()
  return fit_csv(std::move(table), of_table);
}

// The options that need something of a file, of which a capture has its own values.
OptionUses uses_on_capture(const FitRequest& request) {
  OptionUses uses = uses_of(request.size, {});
  const bool is_drift_fitted = request.options.drift == TableDrift::kFitted;
  const bool has_vertical = request.options.vertical_shift != VerticalShift::kAuto;
  add_uses({{"--unverified", request.accepts_unverified, true, ""},
            {"--drift", is_drift_fitted, false, "tables"},
            {"--reference-temperature", request.T_ref_C.has_value(), false, "tables"},
            {"--start-shift", !request.start_shifts.empty(), false, "tables"},
            {"--vertical-shift", has_vertical, false, "tables"},
            {"--sheet", !request.table.sheet.empty(), false, "tables"},
            {"--table", request.table.table > 0, false, "tables"},
            {"--skip", request.table.skip > 0, false, "tables"},
            {"--punch-diameter", request.specimen.has_value(), true, ""},
            {"--frame-stiffness", request.frame_stiffness_N_m > 0.0, true, ""}},
           uses);
  return uses;
}

FittedFile fit_capture(const std::string& path, const FitRequest& request) {
  if (request.kind && *request.kind != FitKind::kIndentation && request.is_one_of_several) {
    throw std::runtime_error(path + ": is a captured run, which is an indentation; write " +
                             "indentation=" + path);
  }
  if (request.kind && *request.kind != FitKind::kIndentation) {
    throw std::runtime_error(path + ": is a captured run, which is an indentation; write " +
                             "indentation=" + path + ", or give the file without a kind");
  }
  if (!request.columns.empty() || !request.segments.empty() || request.time_zero_s ||
      request.from_s || request.to_s || request.hold > 0 || request.crop || request.depth_m ||
      request.modulus_kind) {
    throw std::runtime_error(
        path +
        ": --column, --segment, --time-zero, --from, --to, --hold, --crop, "
        "--depth and --modulus-kind apply only to tables; omit them for a capture");
  }
  const OptionUses uses = uses_on_capture(request);
  if (!request.is_beside_others) refuse_idle(uses);
  CapturedRun run = read_capture(path, {.accepts_damage = request.accepts_unverified});
  // The geometry may be replaced, this value may not.
  const std::string specimen_id = run.specimen.id;
  if (request.specimen) run.specimen = *request.specimen;
  if (request.frame_stiffness_N_m > 0.0) run.rig.frame.stiffness_N_m = request.frame_stiffness_N_m;
  FittedFile fitted;
  if (request.is_one_of_several) {
    fitted = fit_as_table(path, run, request);
    flag_readings(indentation_from_capture(run), fitted.result);
  } else {
    fitted.result = fit_indentation(indentation_from_capture(run), request.options);
  }
  add_uses(uses, fitted.uses);
  fitted.specimen = run.specimen;
  fitted.specimen_id = specimen_id;
  fitted.fitted_unit = "N";
  flag_damage(integrity_notes(run), fitted.result);
  if (run.status != "finished") {
    fitted.result.flags.push_back(
        {"run-" + run.status, 0,
         "the run was not finished; the fit uses the part that was recorded"});
  }
  // Defects of the record that the run itself reported.
  for (const RunEvent& event : run.events) {
    if (event.name != "doubt") continue;
    std::string name = event.value;
    std::replace(name.begin(), name.end(), '_', '-');
    fitted.result.flags.push_back({name, 0, event.text});
  }
  add_temperature(run, fitted);
  note_counted_depth(run, fitted);
  return fitted;
}

// Replaces the answer by the law that was requested.
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

// Fits what `fit` reads. Readers name the file in their messages; the fit does not know it.
template <typename Fit>
FittedFile fit_named(const std::string& path, const FitRequest& request, bool is_capture,
                     const Fit& fit) {
  try {
    FitRequest wanted = request;
    wanted.options.with_laws = request.diagnose || !request.model.empty();
    FittedFile fitted = fit(wanted);
    fitted.path = path;
    const bool accepts_any =
        request.plausible == Plausible::kOff || fitted.specimen.accepts_implausible;
    if (accepts_any) flag_plausible_off(fitted.result.flags);
    if (is_capture && !accepts_any && !fitted.result.is_stiffness) {
      refuse_modulus(fitted.result.E0_Pa, nullptr, {}, request.plausible);
    }
    if (request.diagnose) fitted.fractional = diagnose_fractional(fitted.result);
    take_laws(request, is_capture, fitted);
    return fitted;
  } catch (const std::exception& error) {
    const std::string text = failure_text(error, "fitting this file");
    if (text.find(path) != std::string::npos) throw;
    throw std::runtime_error(path + ": " + text);
  }
}

}  // namespace

const char* name_of_kind(FitKind kind) {
  constexpr const char* kNames[] = {"indentation", "relaxation", "creep", "dma", "several"};
  return kNames[static_cast<std::size_t>(kind)];
}

FittedFile fit_file(const std::string& path, const FitRequest& request) {
  if (request.in_memory) {
    const auto table = request.in_memory->find(path);
    if (table != request.in_memory->end()) return fit_values(table->second, request);
  }
  const bool is_capture = looks_like_capture(path);
  return fit_named(path, request, is_capture, [&](const FitRequest& wanted) {
    return is_capture ? fit_capture(path, wanted) : fit_table(path, wanted);
  });
}

FittedFile fit_values(const CsvTable& table, const FitRequest& request) {
  return fit_named(table.file, request, false, [&](const FitRequest& wanted) {
    FittedFile fitted = fit_csv(table, wanted);
    fitted.is_in_memory = true;
    return fitted;
  });
}

}  // namespace viscard
