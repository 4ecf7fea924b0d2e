#include "io/flow/calibrate.h"
#include "io/flow/capture_setup.h"
#include "io/flow/capture_to_file.h"
#include "io/flow/damaged_table.h"
#include "io/flow/rig_keys.h"
#include "io/options/option.h"
#include "io/python/job.h"
#include "io/python/keywords.h"
#include "io/python/parts.h"
#include "io/python/values.h"
#include "io/tables/column_map.h"

#include <pybind11/stl.h>

namespace viscard::python {
namespace {

namespace py = pybind11;

void check_emulation(const SetupRequest& request) {
  if (!(request.speed > 0.0) || request.speed > kFastestEmulation) {
    throw OptionError("--speed must be above 0 and at most 500");
  }
  if (request.is_emulated) return;
  if (request.truth_file || request.seed || request.speed != 1.0) {
    throw OptionError("--truth, --seed and --speed are for an emulated rig: add --emulate");
  }
  if (!request.rig_file || !request.test_file || request.specimen_file.empty()) {
    throw OptionError(
        "capture needs --rig, --test and --specimen (or --emulate to try it without hardware)");
  }
}

PythonResult capture(const std::string& out, const py::dict& keywords, const py::object& sample,
                     const py::object& progress) {
  using Text = std::optional<std::string>;
  SetupRequest request;  // filled in one by one: a keyword of a wrong type leaves a whole one
  request.rig_file = keywords["rig"].cast<Text>();
  request.test_file = keywords["test"].cast<Text>();
  request.truth_file = keywords["truth"].cast<Text>();
  request.specimen_file = keywords["specimen"].cast<Text>().value_or("");
  request.is_emulated = keywords["emulate"].cast<bool>();
  request.seed = keywords["seed"].cast<std::optional<std::uint64_t>>();
  request.speed = keywords["speed"].cast<double>();
  request.plausible = judged_by(keywords["plausible"].cast<std::string>());
  check_emulation(request);
  const CaptureRequest asked{.setup = setup_from_files(request),
                             .path = out,
                             .overwrite = keywords["overwrite"].cast<bool>(),
                             .command = keywords["command"].cast<std::string>(),
                             .lifts_at_start = keywords["lift"].cast<bool>()};
  safe_preflight(asked.setup);
  if (request.rig_file && !keywords["uncalibrated"].cast<bool>()) {
    refuse_expired_calibration(asked.setup.rig.calibration);
  }
  const bool has_samples = !sample.is_none();
  const Listeners listeners{.progress = progress, .sample = sample, .must_end = true};
  const RunOutcome outcome = in_background(listeners, [=](Job& job) {
    CaptureWatch watch{.stop = &job.stop(), .stop_at_once = &job.stop_at_once()};
    watch.progress = [&](const RunProgress& now) {
      if (!job.stop()) job.report(now.fraction, now.phase);
    };
    if (has_samples) watch.reading = [&](const RunReading& one) { job.add(one); };
    return capture_to_file(asked, watch);
  });
  std::vector<std::string> inputs;
  for (const char* name : {"rig", "test", "specimen", "truth"}) {
    if (const auto file = keywords[name].cast<Text>()) inputs.push_back(*file);
  }
  const CaptureOfSeries shown{.file = out, .run = outcome};
  return {"viscard-capture/1", inputs, [shown](ResultVisitor& v) { show_keys(v, shown); }, {}};
}

CalibrationRequest calibration_request(const std::string& file, const py::dict& keywords,
                                       Plausible judged) {
  const auto quantity = [&](const char* name, const char* unit) {
    return quantity_from(name, keywords[name], unit, judged);
  };
  CalibrationRequest request{.where = file + ": "};
  request.id = keywords["id"].cast<std::string>();
  request.valid_until = keywords["valid_until"].cast<std::string>();
  request.capacity_N = quantity("capacity", "N").value_or(0.0);
  request.span_V = quantity("span", "V");
  request.nonlinearity = keywords["nonlinearity"].cast<std::optional<double>>();
  request.gravity_m_s2 = quantity("gravity", "m/s2");
  request.mass_relative_u = keywords["mass_u"].cast<double>();
  try {
    check_request(request);
  } catch (const std::invalid_argument& error) {
    throw OptionError(error.what());
  }
  return request;
}

// tables: arrays by the name that stands for the file, or none.
py::dict calibrate(const std::string& file, const py::dict& tables, bool is_frame,
                   const py::dict& keywords) {
  const Plausible judged = judged_by(keywords["plausible"].cast<std::string>());
  const auto rig_file = keywords["rig"].cast<std::optional<std::string>>();
  CalibrationRequest request = calibration_request(file, keywords, judged);
  CsvTable table = tables.empty() ? read_csv(file)
                                  : table_from_arrays(tables[py::str(file)].cast<py::dict>(), file);
  (void)accepted_damage(table, false);
  std::size_t n_left_out = 0;
  table = complete_rows(std::move(table), is_frame, n_left_out);
  std::optional<RigConfig> rig;
  if (rig_file)
    rig = is_frame ? read_rig(*rig_file, judged) : read_rig_to_calibrate(*rig_file, judged);
  const RigConfig* of_rig = rig ? &*rig : nullptr;
  std::vector<std::string> inputs{file};
  if (rig_file) inputs.push_back(*rig_file);
  py::dict out;
  out["rows_left_out"] = n_left_out;
  if (is_frame) {
    const BlockPoints points = block_points_from_table(table);
    const auto frame = calibrated_frame(points, gain_relative_u(points, of_rig), request);
    out["result"] = PythonResult{"viscard-calibrate-frame/1",
                                 inputs,
                                 [frame](ResultVisitor& v) { show_keys(v, frame, ""); },
                                 {}};
    out["record"] = toml_from_calibration(frame.record);
    return out;
  }
  if (rig && request.capacity_N == 0.0) request.capacity_N = rig->calibration.capacity_N;
  if (!(request.capacity_N > 0.0)) {
    throw OptionError(
        "capacity is missing: the rated load of the cell, such as \"250 gf\", or a rig file");
  }
  const auto cell = calibrated_cell(readings_from_table(table, request), request, of_rig);
  out["result"] = PythonResult{
      "viscard-calibrate/1", inputs, [cell](ResultVisitor& v) { show_keys(v, cell, ""); }, {}};
  out["record"] = toml_from_calibration(cell.record);
  return out;
}

}  // namespace

void add_rig(py::module_& module) {
  module.def("capture", &capture);
  module.def("calibrate", &calibrate);
}

}  // namespace viscard::python
