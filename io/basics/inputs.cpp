#include "io/basics/inputs.h"

#include "io/basics/json_string.h"
#include "io/basics/program.h"
#include "io/basics/sha256.h"
#include "io/basics/words.h"
#include "io/basics/written_path.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <mutex>
#include <tuple>

namespace viscard {
namespace {

std::mutex& list_mutex() {
  static std::mutex the_mutex;
  return the_mutex;
}

std::vector<InputRecorder*>& recorders() {
  static std::vector<InputRecorder*> all;
  return all;
}

// A different address in every thread.
void* this_thread() {
  thread_local char mark = 0;
  return &mark;
}

std::vector<InputFile> files_of_innermost() {
  const InputRecorder* innermost = nullptr;
  {
    const std::lock_guard<std::mutex> lock(list_mutex());
    for (const InputRecorder* one : recorders()) {
      if (one->is_of_process()) innermost = one;
    }
  }
  return innermost != nullptr ? innermost->files() : std::vector<InputFile>();
}

}  // namespace

InputRecorder::InputRecorder(Of of) : thread_(of == Of::kThread ? this_thread() : nullptr) {
  const std::lock_guard<std::mutex> lock(list_mutex());
  recorders().push_back(this);
}

InputRecorder::~InputRecorder() {
  const std::lock_guard<std::mutex> lock(list_mutex());
  std::erase(recorders(), this);
}

std::vector<InputFile> InputRecorder::files() const {
  const std::lock_guard<std::mutex> lock(list_mutex());
  std::vector<InputFile> sorted = files_;
  std::sort(sorted.begin(), sorted.end(), [](const InputFile& a, const InputFile& b) {
    return std::tie(a.path, a.sha256) < std::tie(b.path, b.sha256);
  });
  return sorted;
}

std::vector<InputFile> provenance_of_inputs() {
  std::vector<InputFile> files = files_of_innermost();
  for (InputFile& file : files) file.path = written_path(file.path);
  return files;
}

std::string head_of_table(const std::string& command) {
  std::string head = "# " + utf8_on_one_line(command) + " (viscard " VISCARD_VERSION ")\n";
  for (const InputFile& file : provenance_of_inputs()) {
    if (!file.note.empty())
      head += "# note: " + utf8_on_one_line(file.path + ": " + file.note) + "\n";
  }
  return head;
}

bool is_input(const std::filesystem::path& path) {
  const std::vector<InputFile> files = files_of_innermost();
  return std::any_of(files.begin(), files.end(), [&](const InputFile& file) {
    std::error_code none;
    return std::filesystem::equivalent(file.path, path, none) && !none;
  });
}

void record_input(const std::filesystem::path& path, const std::string& contents) {
  if (is_recording_inputs()) record_input_sum(path, sha256_of_text(contents));
}

void record_input_sum(const std::filesystem::path& path, const std::string& sha256) {
  const std::lock_guard<std::mutex> lock(list_mutex());
  for (InputRecorder* one : recorders()) {
    if (one->thread_ != nullptr && one->thread_ != this_thread()) continue;
    const bool is_known =
        std::any_of(one->files_.begin(), one->files_.end(), [&](const InputFile& other) {
          return other.path == path.string() && other.sha256 == sha256;
        });
    if (!is_known) one->files_.push_back({path.string(), sha256});
  }
}

void note_input(const std::filesystem::path& path, const std::string& note) {
  const std::lock_guard<std::mutex> lock(list_mutex());
  for (InputRecorder* one : recorders()) {
    for (InputFile& file : one->files_) {
      if (file.path != path.string() || file.note.find(note) != std::string::npos) continue;
      file.note += (file.note.empty() ? "" : "; ") + note;
    }
  }
}

bool is_recording_inputs() {
  const std::lock_guard<std::mutex> lock(list_mutex());
  return !recorders().empty();
}

std::string json_from_inputs(const std::vector<InputFile>& files, bool is_recorded,
                             const std::string& table) {
  nlohmann::ordered_json json = {{"schema", "viscard-inputs/1"},
                                 {"created_by", program_with_version()},
                                 {"is_recorded", is_recorded},
                                 {"table_sha256", sha256_of_text(table)},
                                 {"files", nlohmann::ordered_json::array()}};
  for (const InputFile& file : files) {
    json["files"].push_back({{"path", file.path}, {"sha256", file.sha256}});
    if (!file.note.empty()) json["files"].back()["note"] = file.note;
  }
  return printable_text_from_json(json, 2) + "\n";
}

}  // namespace viscard
