#include "io/flow/series_files.h"

#include "io/capture/capture_file.h"
#include "io/capture/capture_lock.h"
#include "io/config/config_file.h"
#include "io/flow/capture_to_file.h"
#include "models/maths/text_of_number.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>

namespace viscard {
namespace {

namespace fs = std::filesystem;

// Nothing for an empty or damaged capture, and for one that is not finished or lacks readings.
std::optional<CapturedRun> finished_run(const fs::path& path) {
  try {
    CapturedRun run = read_capture(path);
    const RecordIntegrity& found = run.integrity;
    const bool is_whole = found.n_left_out_samples == 0 && found.n_left_out_reports == 0 &&
                          found.n_left_out_temperatures == 0;
    if (run.status == "finished" && is_whole) return run;
  } catch (const std::runtime_error&) {
  }
  return std::nullopt;
}

// The first line in which two descriptions differ, in words; empty: none.
std::string difference(const std::string& of_capture, const std::string& asked) {
  std::istringstream kept_lines(of_capture), asked_lines(asked);
  std::string section;
  while (kept_lines || asked_lines) {
    std::string kept, now;
    std::getline(kept_lines, kept);
    std::getline(asked_lines, now);
    if (kept != now) {
      const auto shown = [](const std::string& line) { return line.empty() ? "no more" : line; };
      return (section.empty() ? "" : "in " + section + " ") + "it has " + shown(kept) +
             ", and asked for is " + shown(now);
    }
    if (kept.starts_with("[")) section = kept;
  }
  return "";
}

void refuse_other(const fs::path& path, const CapturedRun& run, const CaptureSetup& asked) {
  std::string what = "test";
  TestPlan plan = asked.plan;  // how far the surface is searched changes no test
  plan.approach_speed_m_s = run.plan.approach_speed_m_s;
  plan.approach_limit_m = run.plan.approach_limit_m;
  plan.surface_m = run.plan.surface_m;
  plan.surface_margin_m = run.plan.surface_margin_m;
  plan.name = run.plan.name;
  plan.retract_m = run.plan.retract_m;
  plan.retract_speed_m_s = run.plan.retract_speed_m_s;
  plan.accepts_implausible = run.plan.accepts_implausible;
  std::string how = difference(toml_from_test(run.plan), toml_from_test(plan));
  if (how.empty()) {
    what = "specimen";
    Specimen specimen = run.specimen;  // notes and guesses may be mended later
    specimen.id = asked.specimen.id;
    specimen.mixing_ratio = asked.specimen.mixing_ratio;
    specimen.contact = asked.specimen.contact;
    how = difference(toml_from_specimen(run.specimen), toml_from_specimen(specimen));
  }
  if (how.empty()) return;
  throw std::runtime_error(path.string() + " is a finished capture of another " + what + ": " +
                           how + ". Use the files of that capture to go on, or another --out");
}

NextCapture choose_capture(const fs::path& first, bool skips_finished, const CaptureSetup* asked) {
  const int n_attempts = last_attempt(first);
  for (int n = 1; n <= n_attempts; ++n) {
    const fs::path path = attempt_path(first, n);
    if (!fs::exists(path)) continue;
    if (is_being_captured(path)) {
      throw std::runtime_error(path.string() +
                               " is being written by another capture. Wait for it to end");
    }
    if (skips_finished) continue;
    const std::optional<CapturedRun> run = finished_run(path);
    if (!run) continue;
    if (asked != nullptr) refuse_other(path, *run, *asked);
    return {{}, path};
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

NextCapture next_capture(const fs::path& first, const CaptureSetup* asked) {
  return choose_capture(first, false, asked);
}

fs::path further_capture(const fs::path& first) {
  return choose_capture(first, true, nullptr).file;
}

}  // namespace viscard
