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
#include <utility>

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

using Numbers = std::vector<std::uint64_t>;

// The recorders that see what this thread reads, beside those of the process.
Numbers& recorders_of_thread() {
  thread_local Numbers numbers;
  return numbers;
}

}  // namespace

// The innards of recorders; the caller holds the lock.
struct InputRecords {
  static bool sees_this_thread(const InputRecorder& one) {
    const Numbers& numbers = recorders_of_thread();
    return one.of_ == InputRecorder::Of::kProcess ||
           std::find(numbers.begin(), numbers.end(), one.number_) != numbers.end();
  }
  static bool is_of_command(const InputRecorder& one) {
    return one.of_ != InputRecorder::Of::kPart && sees_this_thread(one);
  }
  static std::vector<InputFile>& files(InputRecorder& one) { return one.files_; }
};

namespace {

std::vector<InputFile> files_of_innermost() {
  const InputRecorder* innermost = nullptr;
  {
    const std::lock_guard<std::mutex> lock(list_mutex());
    for (const InputRecorder* one : recorders()) {
      if (InputRecords::is_of_command(*one)) innermost = one;
    }
  }
  return innermost != nullptr ? innermost->files() : std::vector<InputFile>();
}

}  // namespace

InputRecorder::InputRecorder(Of of) : of_(of) {
  static std::uint64_t n_made = 0;
  const std::lock_guard<std::mutex> lock(list_mutex());
  number_ = ++n_made;
  recorders().push_back(this);
  if (of != Of::kProcess) recorders_of_thread().push_back(number_);
}

InputRecorder::~InputRecorder() {
  const std::lock_guard<std::mutex> lock(list_mutex());
  std::erase(recorders(), this);
  std::erase(recorders_of_thread(), number_);
}

std::function<void()> recorded_as_here(std::function<void()> work) {
  return [work = std::move(work), here = recorders_of_thread()] {
    struct Before {
      Numbers numbers = recorders_of_thread();
      ~Before() { recorders_of_thread() = std::move(numbers); }
    } const before;
    recorders_of_thread() = here;
    work();
  };
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
      head += "# note: " + utf8_on_one_line(written_text(file.path + ": " + file.note)) + "\n";
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
  remember_folder_of(path);
  const std::lock_guard<std::mutex> lock(list_mutex());
  for (InputRecorder* one : recorders()) {
    if (!InputRecords::sees_this_thread(*one)) continue;
    std::vector<InputFile>& files = InputRecords::files(*one);
    const auto known = std::find_if(files.begin(), files.end(), [&](const InputFile& other) {
      return other.path == path.string() && other.sha256 == sha256;
    });
    if (known == files.end()) {
      files.push_back({path.string(), sha256});
    } else {
      std::rotate(known, known + 1, files.end());
    }
  }
}

std::optional<std::string> recorded_sum(const std::filesystem::path& path) {
  const std::lock_guard<std::mutex> lock(list_mutex());
  for (auto one = recorders().rbegin(); one != recorders().rend(); ++one) {
    if (!InputRecords::sees_this_thread(**one)) continue;
    const std::vector<InputFile>& files = InputRecords::files(**one);
    const auto last = std::find_if(files.rbegin(), files.rend(), [&](const InputFile& file) {
      return file.path == path.string();
    });
    if (last != files.rend()) return last->sha256;
  }
  return std::nullopt;
}

void note_input(const std::filesystem::path& path, const std::string& note) {
  const std::lock_guard<std::mutex> lock(list_mutex());
  for (InputRecorder* one : recorders()) {
    if (!InputRecords::sees_this_thread(*one)) continue;
    for (InputFile& file : InputRecords::files(*one)) {
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
    json["files"].push_back({{"path", written_path(file.path)}, {"sha256", file.sha256}});
    if (!file.note.empty()) json["files"].back()["note"] = written_text(file.note);
  }
  return printable_text_from_json(json, 2) + "\n";
}

}  // namespace viscard
