#include "io/flow/series_files.h"

#include "io/capture/capture_file.h"
#include "io/capture/capture_lock.h"

#include <fmt/format.h>

#include <stdexcept>

namespace viscard {
namespace {

namespace fs = std::filesystem;

// An empty or damaged capture counts as unfinished.
bool is_finished(const fs::path& path) {
  try {
    return read_capture(path).status == "finished";
  } catch (const std::runtime_error&) {
    return false;
  }
}

NextCapture choose_capture(const fs::path& first, bool skips_finished) {
  for (int n = 1;; ++n) {
    const fs::path path = attempt_path(first, n);
    if (!fs::exists(path)) return {path, {}};
    if (is_being_captured(path)) {
      throw std::runtime_error(path.string() +
                               " is being written by another capture. Wait for it to end");
    }
    if (!skips_finished && is_finished(path)) return {{}, path};
  }
}

}  // namespace

fs::path attempt_path(const fs::path& first, int n) {
  if (n == 1) return first;
  fs::path path = first;
  return path.replace_filename(
      fmt::format("{}.{}{}", first.stem().string(), n, first.extension().string()));
}

NextCapture next_capture(const fs::path& first) {
  return choose_capture(first, false);
}

fs::path further_capture(const fs::path& first) {
  return choose_capture(first, true).file;
}

}  // namespace viscard
