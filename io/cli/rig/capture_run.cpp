#include "io/cli/rig/capture_run.h"

#include "io/basics/atomic_file.h"
#include "io/capture/capture_file.h"
#include "io/capture/capture_lock.h"
#include "io/cli/rig/live_view.h"
#include "io/cli/words/stop_on_signal.h"
#include "rig/emulator/emulated_rig.h"
#include "rig/open_devices.h"

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <ostream>
#include <stdexcept>
#include <utility>

namespace viscard {
namespace {

CapturedRun about_run(const CaptureSetup& setup, const RigConfig& rig, const std::string& command) {
  CapturedRun about;
  about.rig = rig;
  about.plan = setup.plan;
  about.specimen = setup.specimen;
  about.program = "viscard " VISCARD_VERSION;
  about.command = command;
  return about;
}

LiveViewOptions view_options(const CaptureWords& words, const CaptureSetup& setup,
                             const RigConfig& rig, const CaptureWriter& writer) {
  LiveViewOptions options;
  options.capacity_N = rig.calibration.capacity_N;
  options.limit_N = rig.safety.soft_fraction * rig.calibration.capacity_N;
  options.clock_speed = rig.clock_speed;
  options.title = setup.specimen.id.empty() ? words.out_file : setup.specimen.id;
  if (words.shows_page) {
    options.page = std::filesystem::path(words.out_file).replace_extension(kPageEnding);
  }
  if (words.acknowledges) options.n_safe = [&writer] { return writer.counts().committed; };
  return options;
}

// The capture that --force replaces. It stays beside the new one until the run has moved the stage,
// and is restored if that never happens: a cable that is not plugged in, or a punch that presses
// already, must not destroy yesterday's record.
class PreviousCapture {
 public:
  PreviousCapture(std::filesystem::path path, bool is_replaced) : path_(std::move(path)) {
    if (!is_replaced || !std::filesystem::is_regular_file(path_) || is_being_captured(path_)) {
      return;  // the writer reports what is wrong
    }
    if (std::filesystem::exists(aside(""))) {
      throw std::runtime_error(aside("").string() +
                               " is a capture that an earlier --force has kept; move it away");
    }
    move([this](const char* suffix) { return part(suffix); },
         [this](const char* suffix) { return aside(suffix); });
    is_aside_ = true;
  }
  ~PreviousCapture() {
    if (!is_aside_) return;
    try {
      for (const char* suffix : kParts) std::filesystem::remove(part(suffix));
      move([this](const char* suffix) { return aside(suffix); },
           [this](const char* suffix) { return part(suffix); });
    } catch (const std::filesystem::filesystem_error&) {
      // The old capture is still there under its other name.
    }
  }
  PreviousCapture(const PreviousCapture&) = delete;
  PreviousCapture& operator=(const PreviousCapture&) = delete;

  bool is_aside() const { return is_aside_; }
  void drop() {
    if (!is_aside_) return;
    for (const char* suffix : kParts) std::filesystem::remove(aside(suffix));
    is_aside_ = false;
  }

 private:
  static constexpr const char* kParts[] = {"", "-wal", "-shm", "-journal"};

  std::filesystem::path part(const char* suffix) const { return path_.string() + suffix; }
  std::filesystem::path aside(const char* suffix) const {
    return path_.string() + ".previous" + suffix;
  }
  template <class From, class To>
  static void move(From from, To to) {
    for (const char* suffix : kParts) {
      if (std::filesystem::exists(from(suffix))) std::filesystem::rename(from(suffix), to(suffix));
    }
  }

  std::filesystem::path path_;
  bool is_aside_ = false;
};

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
  outcome.reason = fmt::format(
      "{} records were lost because the disk did not keep up. Write to a faster disk", dropped);
}

CaptureOutcome capture_with(const RigConfig& rig, const CaptureWords& words,
                            const CaptureSetup& setup, const std::string& command,
                            Streams& streams) {
  const StopOnSignal on_signal;
  const RigClock clock(rig.clock_speed);
  RigDevices devices = open_ports(rig, clock);
  CaptureOptions options;
  options.overwrite = words.overwrite;
  PreviousCapture previous(words.out_file, words.overwrite);
  CaptureWriter writer(words.out_file, about_run(setup, rig, command), options);
  if (setup.truth) {
    std::filesystem::path path = words.out_file;
    write_file(path.replace_extension(kTruthEnding), json_from_truth(*setup.truth), true);
  }
  const RecordSink sink =
      failing_once([&writer](const RunRecord& record) { writer.append(record); });
  add_drivers(devices, rig, clock, sink);
  LiveView view(streams, view_options(words, setup, rig, writer));
  if (words.shows_page) {
    streams.err << "live page: "
                << std::filesystem::absolute(words.out_file).replace_extension(kPageEnding).string()
                << "\n";
  }
  RunControl control;
  control.clock = &clock;
  control.stop = &StopOnSignal::is_asked();
  control.progress = [&view](const RunProgress& now) { view.update(now); };
  CaptureOutcome outcome;
  outcome.file = words.out_file;
  outcome.run = run_indentation(*devices.stage, *devices.load_cell, rig, setup.plan, setup.specimen,
                                sink, control);
  if (outcome.run.has_begun) {
    previous.drop();
  } else if (previous.is_aside()) {
    outcome.run.reason += ". Nothing was moved: the record that --force was to replace is kept";
  }
  outcome.force_N = view.history().force_N();
  close_file(writer, outcome.run);
  return outcome;
}

}  // namespace

CaptureOutcome capture_once(const CaptureWords& words, const CaptureSetup& setup,
                            const std::string& command, Streams& streams) {
  if (!setup.truth) return capture_with(setup.rig, words, setup, command, streams);
  EmulatedRigOptions options;
  options.truth = *setup.truth;
  options.config = setup.rig;
  const EmulatedRig emulated(options);
  return capture_with(emulated.config(), words, setup, command, streams);
}

}  // namespace viscard
