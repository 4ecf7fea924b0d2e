#include "io/serve/series_folder.h"

#include "io/basics/atomic_file.h"
#include "io/basics/failure_text.h"
#include "io/capture/capture_file.h"
#include "io/config/config_file.h"
#include "io/flow/series_files.h"
#include "io/serve/api_error.h"
#include "models/experiment/test_phases.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
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

std::vector<SeriesSpecimen::Capture> captures_of(const fs::path& first) {
  std::vector<SeriesSpecimen::Capture> captures;
  for (int n = 1; fs::exists(attempt_path(first, n)); ++n) {
    const fs::path path = attempt_path(first, n);
    SeriesSpecimen::Capture capture{path.filename().string(), "unreadable", "", ""};
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
  write_file(test_file(), toml_from_test(plan), true);
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

SeriesSpecimen SeriesFolder::specimen_of_capture(const std::string& file) const {
  for (SeriesSpecimen& specimen : specimens()) {
    for (const SeriesSpecimen::Capture& capture : specimen.captures) {
      if (capture.file == file) return specimen;
    }
  }
  throw ApiError(404, "not-found", "there is no capture '" + file + "' in " + folder_.string());
}

}  // namespace viscard
