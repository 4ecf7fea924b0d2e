#include "io/flow/series_files.h"

#include "io/capture/capture_file.h"
#include "io/capture/capture_lock.h"
#include "models/maths/text_of_number.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <string>

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
  const int n_attempts = last_attempt(first);
  for (int n = 1; n <= n_attempts; ++n) {
    const fs::path path = attempt_path(first, n);
    if (!fs::exists(path)) continue;
    if (is_being_captured(path)) {
      throw std::runtime_error(path.string() +
                               " is being written by another capture. Wait for it to end");
    }
    if (!skips_finished && is_finished(path)) return {{}, path};
  }
  return {attempt_path(first, n_attempts + 1), {}};
}

}  // namespace

fs::path attempt_path(const fs::path& first, int n) {
  if (n == 1) return first;
  fs::path path = first;
  return path.replace_filename(
      fmt::format("{}.{}{}", first.stem().string(), n, first.extension().string()));
}

int last_attempt(const fs::path& first) {
  int last = fs::exists(first) ? 1 : 0;
  const std::string head = first.stem().string() + ".", tail = first.extension().string();
  std::error_code is_gone;
  const fs::path folder = first.has_parent_path() ? first.parent_path() : fs::path(".");
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, is_gone)) {
    const std::string name = entry.path().filename().string();
    if (name.size() <= head.size() + tail.size() || name.rfind(head, 0) != 0) continue;
    const auto n =
        integer_from_text(name.substr(head.size(), name.size() - head.size() - tail.size()));
    constexpr long long kMost = 9'999;  // captures of one specimen
    if (!n || *n < 2 || *n > kMost || attempt_path(first, static_cast<int>(*n)).filename() != name)
      continue;
    last = std::max(last, static_cast<int>(*n));
  }
  return last;
}

NextCapture next_capture(const fs::path& first) {
  return choose_capture(first, false);
}

fs::path further_capture(const fs::path& first) {
  return choose_capture(first, true).file;
}

}  // namespace viscard
