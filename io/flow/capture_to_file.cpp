#include "io/flow/capture_to_file.h"

#include "io/basics/atomic_file.h"
#include "io/basics/inputs.h"
#include "io/basics/program.h"
#include "io/capture/capture_header.h"
#include "io/capture/capture_lock.h"
#include "rig/emulator/emulated_rig.h"
#include "rig/open_devices.h"
#include "rig/run/count_comparison.h"
#include "rig/run_indentation.h"

#include <fmt/format.h>

#include <exception>
#include <optional>
#include <utility>

namespace viscard {
namespace {

CapturedRun about_run(const CaptureRequest& request, const RigConfig& rig) {
  CapturedRun about;
  about.rig = rig;
  about.plan = request.setup.plan;
  about.specimen = request.setup.specimen;
  about.program = program_with_version();
  about.command = request.command;
  return about;
}

// Ends the file. A run that lost records because of a slow disk counts as interrupted.
void close_file(CaptureWriter& writer, RunOutcome& outcome) {
  try {
    writer.finish(outcome.status == "finished" ? "finished" : "interrupted");
  } catch (const std::exception& error) {
    if (outcome.reason.empty()) throw;  // otherwise the reason is this failure
  }
  const std::size_t dropped = writer.counts().dropped;
  if (dropped == 0 || outcome.status != "finished") return;
  outcome.status = "interrupted";
  outcome.code = "records-lost";
  outcome.reason = fmt::format(
      "{} records were lost because the disk did not keep up. Write to a faster disk", dropped);
}

// Calls `closing` at the end of its scope, also after an exception.
class ClosingCall {
 public:
  explicit ClosingCall(const CaptureWatch& watch) : watch_(watch) {}
  ~ClosingCall() {
    if (watch_.closing) watch_.closing();
  }
  ClosingCall(const ClosingCall&) = delete;
  ClosingCall& operator=(const ClosingCall&) = delete;

 private:
  const CaptureWatch& watch_;
};

// An emulated rig learns in which phase the test is, because its fault may begin with one.
RecordSink told_to(EmulatedRig* emulated, RecordSink sink) {
  if (emulated == nullptr) return sink;
  return [emulated, sink = std::move(sink)](const RunRecord& record) {
    sink(record);
    const auto* event = std::get_if<RunEvent>(&record);
    if (event != nullptr && event->name == "phase") emulated->enter_phase(event->value);
  };
}

RunOutcome capture_with(const RigConfig& rig, const RigClock& clock, EmulatedRig* emulated,
                        const CaptureRequest& request, const CaptureWatch& watch) {
  const CaptureSetup& setup = request.setup;
  // No file is made before the ports are open, and drivers say their last words into it.
  std::optional<PreviousCapture> kept;
  std::optional<CaptureWriter> written;
  RigDevices devices = open_ports(rig, clock);
  CaptureOptions options;
  options.overwrite = request.overwrite;
  if (request.overwrite) refuse_input(request.path);
  PreviousCapture& previous = kept.emplace(request.path, request.overwrite);
  options.rights = previous.rights();
  note_output(request.path);
  CaptureWriter& writer = written.emplace(request.path, about_run(request, rig), options);
  if (setup.truth) {
    std::filesystem::path path = request.path;
    write_file(path.replace_extension(kTruthEnding), json_from_truth(*setup.truth), true);
  }
  const RecordSink sink = told_to(
      emulated, failing_once([&writer](const RunRecord& record) { writer.append(record); }));
  RigConfig of_drivers = rig;
  if (request.homing != nullptr && request.homing->has_homed) of_drivers.stage.home = false;
  add_drivers(devices, of_drivers, clock, sink);
  const ClosingCall closing(watch);
  if (watch.opened) watch.opened(rig, writer);
  RunControl control;
  control.clock = &clock;
  control.stop = watch.stop;
  control.stop_at_once = watch.stop_at_once;
  control.progress = watch.progress;
  control.reading = watch.reading;
  control.lifts_at_start = request.lifts_at_start;
  control.thermometer = devices.thermometer.get();
  control.has_answered = setup.truth.has_value();
  if (request.homing != nullptr) {
    control.has_answered |= request.homing->has_answered;
    control.homed_before = request.homing->homed;
    control.homes_after = request.homing->is_last && !request.homing->is_doubtful;
  }
  RunOutcome outcome = run_indentation(*devices.stage, *devices.load_cell, rig, setup.plan,
                                       setup.specimen, sink, control);
  if (outcome.has_begun) {
    previous.drop();
  } else if (previous.is_aside()) {
    outcome.reason +=
        ". The approach had not begun: the record that --force was to replace is kept";
  }
  close_file(writer, outcome);
  if (request.homing != nullptr) {
    request.homing->has_homed = true;
    request.homing->has_answered |= outcome.contact_position_m.has_value();
    request.homing->homed = outcome.homed;
    request.homing->is_doubtful |= outcome.status != "finished" || !outcome.doubts.empty();
  }
  return outcome;
}

// In a series the stage goes on where an earlier run has left its count.
EmulatedRigOptions emulated_options(const CaptureRequest& request) {
  const CaptureSetup& setup = request.setup;
  EmulatedRigOptions options = able_rig(*setup.truth, setup.rig);
  options.fault = setup.fault;
  if (request.homing == nullptr) return options;
  options.grbl.is_homed = request.homing->homed.has_value();
  if (options.grbl.is_homed) options.grbl.counts_m = request.homing->emulated_counted_m;
  options.lost_before_m = request.homing->emulated_lost_m;
  return options;
}

}  // namespace

std::vector<UnchangedCapture> share_count(const std::vector<EarlierRun>& earlier,
                                          const RunOutcome& last) {
  std::vector<UnchangedCapture> unchanged;
  if (!last.count) return unchanged;
  std::string doubt = lost_steps_doubt(*last.count);
  const bool is_right = doubt.empty();
  if (!is_right) {
    doubt += fmt::format(". The stage was homed after {} runs: in which of them is not known",
                         earlier.size() + 1);
  }
  const RunEvent event =
      is_right ? RunEvent{0.0, "depth", last.depth_is,
                          "Counted in steps; homed at the end of the series, the stage stood there"}
               : RunEvent{0.0, "doubt", kLostStepsDoubt, doubt};
  for (const EarlierRun& run : earlier) {
    run.outcome->count = last.count;
    if (is_right) {
      run.outcome->depth_is = last.depth_is;
    } else {
      run.outcome->doubts.push_back(doubt);
    }
    try {
      add_late_event(run.path, event.name, event.value, event.text);
    } catch (const std::exception& error) {
      unchanged.push_back(
          {run.path, (is_right ? "that the count of steps was compared is missing in a capture, "
                                 "and its fit takes the depth as counted: "
                               : "the doubt that the stage has lost steps is missing in a capture; "
                                 "leave that one out of fits: ") +
                         std::string(error.what())});
    }
  }
  return unchanged;
}

RunOutcome capture_to_file(const CaptureRequest& request, const CaptureWatch& watch) {
  const RigConfig& rig = request.setup.rig;
  if (request.overwrite) refuse_other_than_capture(request.path);
  if (!request.setup.truth) {
    return capture_with(rig, RigClock(rig.clock_speed), nullptr, request, watch);
  }
  EmulatedRig emulated(emulated_options(request));
  RunOutcome outcome = capture_with(emulated.config(), emulated.clock(), &emulated, request, watch);
  if (request.homing != nullptr) {
    request.homing->emulated_lost_m = emulated.outcome().lost_m;
    request.homing->emulated_counted_m = emulated.outcome().counted_m;
  }
  if (watch.note && emulated.awaits_fault()) {
    watch.note("the fault '" + name_of(request.setup.fault.kind) +
               "' was never reached: the run ended before it");
  }
  return outcome;
}

}  // namespace viscard
