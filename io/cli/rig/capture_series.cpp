#include "io/capture/capture_file.h"
#include "io/capture/capture_lock.h"
#include "io/cli/rig/capture_words.h"

#include <fmt/format.h>

#include <filesystem>
#include <stdexcept>

namespace viscard {
namespace {

namespace fs = std::filesystem;

// The n-th file for the same specimen: run.viscap, run.2.viscap, run.3.viscap ...
fs::path attempt_path(const fs::path& first, int n) {
  if (n == 1) return first;
  fs::path path = first;
  return path.replace_filename(
      fmt::format("{}.{}{}", first.stem().string(), n, first.extension().string()));
}

// An empty or damaged capture counts as unfinished.
bool is_finished(const fs::path& path) {
  try {
    return read_capture(path).status == "finished";
  } catch (const std::runtime_error&) {
    return false;
  }
}

void choose_file(SeriesStep& step) {
  for (int n = 1;; ++n) {
    const fs::path path = attempt_path(step.out_file, n);
    if (!fs::exists(path)) {
      step.out_file = path.string();
      return;
    }
    if (is_being_captured(path)) {
      throw std::runtime_error(path.string() +
                               " is being written by another capture. Wait for it to end");
    }
    if (is_finished(path)) {
      step.finished_file = path.string();
      return;
    }
  }
}

}  // namespace

std::vector<SeriesStep> series_from_words(const CaptureWords& words) {
  std::vector<SeriesStep> steps;
  if (words.specimen_files.size() <= 1) {
    steps.push_back(
        {words.specimen_files.empty() ? "" : words.specimen_files[0], words.out_file, ""});
  } else {
    const fs::path folder = words.out_file;
    if (fs::exists(folder) && !fs::is_directory(folder)) {
      throw std::runtime_error("'" + words.out_file +
                               "' is a file; with several specimens --out names a folder");
    }
    fs::create_directories(folder);
    for (std::size_t i = 0; i < words.specimen_files.size(); ++i) {
      const std::string stem = fs::path(words.specimen_files[i]).stem().string();
      const fs::path file = folder / fmt::format("{:02}_{}.viscap", i + 1, stem);
      steps.push_back({words.specimen_files[i], file.string(), ""});
    }
  }
  if (words.resumes) {
    for (SeriesStep& step : steps) choose_file(step);
  }
  return steps;
}

}  // namespace viscard
