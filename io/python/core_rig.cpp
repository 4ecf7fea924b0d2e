#include "io/flow/capture_setup.h"
#include "io/flow/capture_to_file.h"
#include "io/flow/rig_keys.h"
#include "io/options/option.h"
#include "io/python/job.h"
#include "io/python/keywords.h"
#include "io/python/parts.h"
#include "io/python/values.h"

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

}  // namespace

void add_rig(py::module_& module) {
  module.def("capture", &capture);
}

}  // namespace viscard::python
