#include "io/cli/rig/capture_words.h"
#include "io/cli/rig/live_view.h"
#include "io/cli/words/stop_on_signal.h"

#include <filesystem>
#include <optional>
#include <ostream>

namespace viscard {
namespace {

LiveViewOptions view_options(const CaptureWords& words, const CaptureSetup& setup,
                             const RigConfig& rig, const CaptureWriter& writer) {
  LiveViewOptions options;
  options.capacity_N = rig.calibration.capacity_N;
  options.limit_N = rig.safety.soft_fraction * rig.calibration.capacity_N;
  options.clock_speed = setup.rig.clock_speed;  // an emulated rig does not know its pace
  options.title = setup.specimen.id.empty() ? words.out_file : setup.specimen.id;
  if (words.shows_page) {
    options.page = std::filesystem::path(words.out_file).replace_extension(kPageEnding);
  }
  if (words.acknowledges) options.counts = [&writer] { return writer.counts(); };
  return options;
}

}  // namespace

CaptureOutcome capture_once(const CaptureWords& words, const CaptureSetup& setup,
                            SeriesHoming& homing, const std::string& command, Streams& streams) {
  const StopOnSignal on_signal;
  CaptureOutcome outcome;
  outcome.file = words.out_file;
  std::optional<LiveView> view;
  CaptureWatch watch;
  watch.stop = &StopOnSignal::is_asked();
  watch.opened = [&](const RigConfig& rig, const CaptureWriter& writer) {
    view.emplace(streams, view_options(words, setup, rig, writer));
    if (!words.shows_page) return;
    const std::filesystem::path file = std::filesystem::absolute(words.out_file);
    streams.err << "live page: "
                << std::filesystem::path(file).replace_extension(kPageEnding).string() << "\n";
  };
  watch.progress = [&](const RunProgress& now) { view->update(now); };
  watch.closing = [&] {
    if (view) outcome.force_N = view->history().force_N();
    view.reset();
  };
  watch.note = [&](const std::string& text) { streams.err << "viscard: " << text << "\n"; };
  outcome.run = capture_to_file(
      {setup, words.out_file, words.overwrite, command, words.lifts_at_start, &homing}, watch);
  return outcome;
}

}  // namespace viscard
