#include "io/serve/series_folder.h"

#include "io/basics/atomic_file.h"
#include "io/basics/file_kind.h"
#include "io/capture/capture_file.h"
#include "io/capture/capture_lock.h"
#include "io/config/config_file.h"
#include "io/flow/series_files.h"
#include "io/materials/material_file.h"
#include "io/serve/api_error.h"
#include "models/experiment/test_phases.h"
#include "models/maths/failure_text.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <sstream>
#include <system_error>
#include <utility>

namespace viscard {
namespace {

namespace fs = std::filesystem;

constexpr const char* kSpecimenEnding = ".toml";
constexpr const char* kTruthTomlEnding = ".truth.toml";
constexpr const char* kCaptureEnding = ".viscap";
constexpr std::size_t kLongestName = 40;

bool ends_with(const std::string& text, const std::string& ending) {
  return text.size() >= ending.size() &&
         text.compare(text.size() - ending.size(), ending.size(), ending) == 0;
}

// The number that a name begins with, or 0.
long long number_of_name(const std::string& name) {
  constexpr std::size_t kMostDigits = 15;
  const std::size_t n_digits = std::min(name.find_first_not_of("0123456789"), name.size());
  return n_digits == 0 || n_digits > kMostDigits ? 0 : std::stoll(name.substr(0, n_digits));
}

bool comes_before(const SeriesSpecimen& a, const SeriesSpecimen& b) {
  return std::pair(number_of_name(a.name), a.name) < std::pair(number_of_name(b.name), b.name);
}

bool is_specimen_file(const std::string& file) {
  return ends_with(file, kSpecimenEnding) && !ends_with(file, kTruthTomlEnding) &&
         file != "test.toml" && file != "rig.toml" && file.front() != '.';
}

// The text of a specimen's file with another id; its comments stay.
std::string with_id(const std::string& text, const Specimen& renamed) {
  std::istringstream lines(toml_from_specimen(renamed));
  std::string id_line;
  while (std::getline(lines, id_line) && id_line.rfind("id", 0) != 0) {
  }
  std::istringstream old(text);
  std::string out, line;
  bool is_done = false, is_in_section = false;
  while (std::getline(old, line)) {
    is_in_section = is_in_section || line.rfind('[', 0) == 0;
    const bool is_id =
        !is_done && !is_in_section && (line.rfind("id ", 0) == 0 || line.rfind("id=", 0) == 0);
    out += (is_id ? id_line : line) + "\n";
    is_done = is_done || is_id;
  }
  return is_done ? out : toml_from_specimen(renamed);
}

// A record of the page, or one that was put there.
bool is_calibration(const fs::path& file) {
  try {
    return kind_of_file(read_file(file)) == FileKind::kCalibration;
  } catch (const std::exception&) {
    return false;
  }
}

// Lower-case letters, digits and hyphens of a name that a person has typed.
std::string file_name_from(const std::string& id) {
  std::string name;
  for (const char c : id) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x80 && std::isalnum(byte) != 0) {
      name += static_cast<char>(std::tolower(byte));
    } else if (!name.empty() && name.back() != '-') {
      name += '-';
    }
  }
  name.resize(std::min(name.size(), kLongestName));
  while (!name.empty() && name.back() == '-') name.pop_back();
  return name.empty() ? "specimen" : name;
}

// A pipe in the place of a file would be waited for without end.
void require_plain(const fs::path& file) {
  std::error_code is_gone;
  const fs::file_status status = fs::status(file, is_gone);
  if (!fs::exists(status) || fs::is_regular_file(status)) return;
  throw std::runtime_error(file.string() + " is no ordinary file; move it elsewhere");
}

fs::path note_file(const fs::path& capture) {
  return fs::path(capture.string() + ".note.txt");
}

std::string note_of(const fs::path& capture) {
  const fs::path file = note_file(capture);
  if (!fs::is_regular_file(fs::symlink_status(file))) return "";
  try {
    return read_file(file);
  } catch (const std::exception& error) {
    return failure_text(error, "this note");
  }
}

std::vector<SeriesSpecimen::Capture> captures_of(const fs::path& first) {
  std::vector<SeriesSpecimen::Capture> captures;
  const int n_attempts = last_attempt(first);
  for (int n = 1; n <= n_attempts; ++n) {
    const fs::path path = attempt_path(first, n);
    if (!fs::exists(path)) continue;  // taken away
    SeriesSpecimen::Capture capture{path.filename().string(), "unreadable", "", "", note_of(path)};
    try {
      const CaptureState state = read_capture_state(path);
      capture.status = state.status;
      capture.started_at = state.started_at;
    } catch (const std::exception& error) {
      capture.trouble = failure_text(error, "this capture");
    }
    captures.push_back(capture);
  }
  return captures;
}

// The captures of a specimen "a.2" would have the names of further captures of a specimen "a".
void refuse_shared_names(std::vector<SeriesSpecimen>& specimens) {
  for (SeriesSpecimen& specimen : specimens) {
    const std::size_t dot = specimen.name.rfind('.');
    if (dot == std::string::npos || dot + 1 == specimen.name.size() ||
        specimen.name.find_first_not_of("0123456789", dot + 1) != std::string::npos) {
      continue;
    }
    const std::string other = specimen.name.substr(0, dot);
    if (std::any_of(specimens.begin(), specimens.end(),
                    [&](const SeriesSpecimen& one) { return one.name == other; })) {
      specimen.captures.clear();
      specimen.trouble = specimen.name + ".toml: its captures would have the names of those of '" +
                         other + "'. Rename the file";
    }
  }
}

}  // namespace

std::string SeriesSpecimen::state() const {
  const auto has = [&](const char* status) {
    return std::any_of(captures.begin(), captures.end(),
                       [&](const Capture& capture) { return capture.status == status; });
  };
  if (has("running")) return "running";
  if (has("finished")) return "finished";
  return captures.empty() ? "none" : "interrupted";
}

SeriesFolder::SeriesFolder(const fs::path& folder) : folder_(fs::absolute(folder)) {
  if (fs::exists(folder_) && !fs::is_directory(folder_)) {
    throw std::runtime_error(folder_.string() +
                             " is a file; name the folder that holds the series");
  }
  std::error_code error;
  fs::create_directory(folder_, error);
  if (error) {
    throw std::runtime_error(folder_.string() + ": cannot create this folder: " + error.message() +
                             ". Name one that you may write to");
  }
}

std::string SeriesFolder::trouble() const {
  std::error_code error;
  if (!fs::is_directory(folder_, error)) {
    return folder_.string() + " is gone. Bring it back, or start viscard serve with another folder";
  }
  if (::faccessat(AT_FDCWD, folder_.c_str(), W_OK | X_OK, AT_EACCESS) == 0) return "";
  return folder_.string() + " cannot be written to: " + std::strerror(errno) +
         ". What is in it is shown; for a test, start viscard serve with a folder of your own";
}

fs::path SeriesFolder::specimen_file(const std::string& name) const {
  return folder_ / (name + kSpecimenEnding);
}

fs::path SeriesFolder::first_capture(const std::string& name) const {
  return folder_ / (name + kCaptureEnding);
}

std::optional<std::string> SeriesFolder::truth_file(const std::string& name) const {
  const fs::path file = folder_ / (name + kTruthTomlEnding);
  return fs::exists(file) ? std::optional(file.string()) : std::nullopt;
}

TestPlan SeriesFolder::test() const {
  require_plain(test_file());
  if (fs::exists(test_file())) return read_test(test_file());
  TestPlan plan;
  plan.name = "stress relaxation";
  return plan;
}

void SeriesFolder::check_test(const TestPlan& plan) const {
  phases_from_plan(plan);
  test_from_toml(toml_from_test(plan), "test.toml", Plausible::kMeasured);
}

void SeriesFolder::save_test(const TestPlan& plan) const {
  check_test(plan);
  rewrite_file(test_file(), toml_from_test(plan));
}

void SeriesFolder::save_test_text(const std::string& text, const TestPlan& plan) const {
  check_test(plan);
  rewrite_file(test_file(), text);
}

std::string SeriesFolder::test_text() const {
  require_plain(test_file());
  return fs::exists(test_file()) ? read_file(test_file()) : toml_from_test(test());
}

std::vector<SeriesSpecimen> SeriesFolder::specimens() const {
  std::vector<SeriesSpecimen> specimens;
  std::error_code is_gone;  // trouble() reports it
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_, is_gone)) {
    const std::string file = entry.path().filename().string();
    if (!is_specimen_file(file) || !entry.is_regular_file()) continue;
    SeriesSpecimen specimen;
    specimen.name = entry.path().stem().string();
    try {
      specimen.specimen = read_specimen(entry.path());
    } catch (const std::exception& error) {
      if (is_calibration(entry.path())) continue;
      specimen.trouble = failure_text(error, "this specimen");
    }
    specimen.captures = captures_of(first_capture(specimen.name));
    const fs::path material = folder_ / (specimen.name + ".json");
    if (fs::exists(material)) specimen.material_file = material.filename().string();
    specimens.push_back(std::move(specimen));
  }
  refuse_shared_names(specimens);
  std::sort(specimens.begin(), specimens.end(), comes_before);
  return specimens;
}

SeriesSpecimen SeriesFolder::specimen_named(const std::string& name) const {
  for (SeriesSpecimen& specimen : specimens()) {
    if (specimen.name == name) return specimen;
  }
  throw ApiError(404, "not-found",
                 "there is no specimen '" + name + "' in " + folder_.string() +
                     ". Choose one of the list, or add it");
}

std::string SeriesFolder::add_specimen(const Specimen& specimen) const {
  const std::string toml = toml_from_specimen(specimen);
  require_id(specimen_from_toml(toml, "specimen", Plausible::kMeasured), toml, "specimen");
  long long number = 1;
  for (const SeriesSpecimen& other : specimens()) {
    number = std::max(number, 1 + number_of_name(other.name));
  }
  std::string name = fmt::format("{:02}_{}", number, file_name_from(specimen.id));
  write_file(specimen_file(name), toml, false);
  return name;
}

void SeriesFolder::remove_specimen(const std::string& name) const {
  const SeriesSpecimen specimen = specimen_named(name);
  if (!specimen.captures.empty()) {
    throw ApiError(409, "has-captures",
                   "'" + name + "' has captures, so it is kept. Move " + name +
                       ".toml and its captures to another folder by hand");
  }
  fs::remove(specimen_file(name));
  sync_folder(folder_);
}

std::string SeriesFolder::rename_specimen(const std::string& name, const std::string& id) const {
  const SeriesSpecimen found = specimen_named(name);
  if (!found.captures.empty()) {
    throw ApiError(
        409, "has-captures",
        "'" + name + "' has captures, and they hold its name. Add a specimen of the new name");
  }
  if (!found.specimen) throw ApiError(409, "unreadable", found.trouble);
  Specimen renamed = *found.specimen;
  renamed.id = id;
  const std::string toml = with_id(read_file(specimen_file(name)), renamed);
  require_id(specimen_from_toml(toml, "specimen", Plausible::kMeasured), toml, "specimen");
  const long long number = number_of_name(name);
  std::string other =
      number > 0 ? fmt::format("{:02}_{}", number, file_name_from(id)) : file_name_from(id);
  if (!is_specimen_file(other + kSpecimenEnding)) other = "specimen-" + other;
  if (other == name) {
    rewrite_file(specimen_file(name), toml);
    return name;
  }
  for (const fs::path& taken : {specimen_file(other), folder_ / (other + kTruthTomlEnding)}) {
    if (!fs::exists(fs::symlink_status(taken))) continue;
    throw ApiError(409, "name-taken", taken.filename().string() + " exists; choose another name");
  }
  write_file(specimen_file(other), toml, false);
  if (const auto truth = truth_file(name)) fs::rename(*truth, folder_ / (other + kTruthTomlEnding));
  fs::remove(specimen_file(name));
  sync_folder(folder_);
  return other;
}

std::string SeriesFolder::trash_capture(const std::string& file) const {
  const SeriesSpecimen specimen = specimen_of_capture(file);
  const fs::path path = folder_ / file;
  if (is_being_captured(path)) throw ApiError(409, "busy", file + " is being written");
  if (!specimen.material_file.empty()) {
    const auto sources =
        read_material(folder_ / specimen.material_file).material.provenance.raw_files;
    const bool is_source = std::any_of(sources.begin(), sources.end(), [&](const RawFile& source) {
      return fs::path(source.path).filename() == file;
    });
    if (is_source) {
      throw ApiError(409, "in-use",
                     specimen.material_file + " was made of " + file +
                         ", so it is kept. Move that material to another folder first");
    }
  }
  const fs::path trash = folder_ / "trash";
  const fs::file_status is_there = fs::symlink_status(trash);
  if (fs::exists(is_there) && !fs::is_directory(is_there)) {
    throw ApiError(409, "no-folder",
                   "'trash' in " + folder_.string() + " is no folder; rename it first");
  }
  fs::create_directory(trash);
  const auto is_taken = [](const fs::path& one) {
    return fs::exists(fs::symlink_status(one)) || fs::exists(fs::symlink_status(note_file(one)));
  };
  fs::path to = trash / file;
  for (int n = 2; is_taken(to); ++n) {
    to = trash / (fs::path(file).stem().string() + "." + std::to_string(n) + kCaptureEnding);
  }
  // The capture last: without it the others mean nothing.
  for (const char* ending : {".note.txt", "-wal", "-shm"}) {
    if (fs::exists(path.string() + ending))
      fs::rename(path.string() + ending, to.string() + ending);
  }
  fs::rename(path, to);
  sync_folder(folder_);
  return to.filename().string();
}

void SeriesFolder::note_capture(const std::string& file, const std::string& note) const {
  constexpr std::size_t kLongestNote = 4000;
  specimen_of_capture(file);
  if (note.size() > kLongestNote)
    throw ApiError(400, "bad-value", "a note has at most 4000 characters");
  if (note.empty()) {
    fs::remove(note_file(folder_ / file));
    sync_folder(folder_);
  } else {
    rewrite_file(note_file(folder_ / file), note);
  }
}

SeriesSpecimen SeriesFolder::specimen_of_capture(const std::string& file) const {
  for (SeriesSpecimen& specimen : specimens()) {
    for (const SeriesSpecimen::Capture& capture : specimen.captures) {
      if (capture.file == file) return specimen;
    }
  }
  throw ApiError(404, "not-found", "there is no capture '" + file + "' in " + folder_.string());
}

}  // namespace viscard
