#include "io/cli/rig/capture_words.h"
#include "io/flow/series_files.h"

#include <fmt/format.h>

#include <filesystem>
#include <stdexcept>

namespace viscard {
namespace {

namespace fs = std::filesystem;

void choose_file(SeriesStep& step) {
  const NextCapture next = next_capture(step.out_file);
  if (next.finished.empty()) {
    step.out_file = next.file.string();
  } else {
    step.finished_file = next.finished.string();
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
