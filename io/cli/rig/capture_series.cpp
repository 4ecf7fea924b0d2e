#include "io/cli/rig/capture_words.h"
#include "io/cli/words/progress.h"
#include "io/cli/words/stop_on_signal.h"
#include "io/flow/series_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <filesystem>
#include <stdexcept>
#include <thread>

namespace viscard {
namespace {

namespace fs = std::filesystem;

void choose_file(const CaptureWords& words, SeriesStep& step) {
  const CaptureSetup asked = capture_setup(words, step);
  const NextCapture next = next_capture(step.out_file, &asked);
  if (next.finished.empty()) {
    step.out_file = next.file.string();
  } else {
    step.finished_file = next.finished.string();
  }
}

// A folder for several captures.
fs::path made_folder(const CaptureWords& words) {
  fs::path folder = words.out_file;
  if (fs::exists(folder) && !fs::is_directory(folder)) {
    throw std::runtime_error(
        "'" + words.out_file +
        "' is a file; with several specimens or --repeat --out names a folder");
  }
  fs::create_directories(folder);
  return folder;
}

// The largest number of a touch among the files of this specimen, finished or not.
int last_touch_in(const fs::path& folder, const std::string& stem) {
  int last = 0;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (name.rfind(stem, 0) != 0) continue;
    int number = 0;
    const char* begin = name.data() + stem.size();
    std::from_chars(begin, name.data() + name.size(), number);
    last = std::max(last, number);
  }
  return last;
}

void add_touches(const CaptureWords& words, const fs::path& folder, const SeriesStep& of_specimen,
                 const std::string& name, std::vector<SeriesStep>& steps) {
  const std::string stem = name + "_touch";
  const int before = words.resumes ? 0 : last_touch_in(folder, stem);
  for (int k = 1; k <= words.repeats; ++k) {
    SeriesStep step = of_specimen;
    step.touch = before + k;
    step.last_touch = before + words.repeats;
    step.out_file = (folder / fmt::format("{}{:02}.viscap", stem, step.touch)).string();
    steps.push_back(step);
  }
}

}  // namespace

std::vector<SeriesStep> series_from_words(const CaptureWords& words) {
  const std::vector<std::string> specimens =
      words.specimen_files.empty() ? std::vector<std::string>{""} : words.specimen_files;
  std::vector<SeriesStep> steps;
  const bool is_single = specimens.size() == 1 && words.repeats == 1;
  const fs::path folder = is_single ? fs::path() : made_folder(words);
  for (std::size_t i = 0; i < specimens.size(); ++i) {
    SeriesStep step{.specimen_file = specimens[i], .out_file = words.out_file, .specimen = i};
    const std::string stem =
        specimens[i].empty() ? "specimen" : fs::path(specimens[i]).stem().string();
    const std::string name = fmt::format("{:02}_{}", i + 1, stem);
    if (words.repeats > 1) {
      add_touches(words, folder, step, name, steps);
      continue;
    }
    if (!is_single) step.out_file = (folder / (name + ".viscap")).string();
    steps.push_back(step);
  }
  if (words.resumes) {
    for (SeriesStep& step : steps) choose_file(words, step);
  }
  return steps;
}

bool wait_lifted(const SeriesStep& step, const CaptureWords& words, Streams& streams) {
  using Clock = std::chrono::steady_clock;
  constexpr double kUsual_s = 60.0;
  const StopOnSignal on_signal;
  const double wait_s = words.lift_wait_s.value_or(kUsual_s);
  const double wall_s = wait_s / (words.is_emulated ? words.speed : 1.0);
  streams.err << fmt::format(
      "viscard: touch {} of {} is recorded; the punch stays lifted for {:g} s (Ctrl-C ends the "
      "series)\n",
      step.touch - 1, step.last_touch, wait_s);
  Progress progress(streams, "lifted");
  const Clock::time_point begun = Clock::now();
  while (!StopOnSignal::is_asked()) {
    const double done_s = std::chrono::duration<double>(Clock::now() - begun).count();
    if (done_s >= wall_s) return true;
    progress.show(done_s / wall_s, fmt::format("before touch {}", step.touch));
    constexpr double kLook_s = 0.05;
    std::this_thread::sleep_for(std::chrono::duration<double>(std::min(kLook_s, wall_s - done_s)));
  }
  return false;
}

}  // namespace viscard
