#include "io/basics/inputs.h"

#include "io/basics/json_string.h"
#include "io/basics/program.h"
#include "io/basics/sha256.h"
#include "io/basics/words.h"
#include "io/basics/written_path.h"

#include <fcntl.h>
#include <nlohmann/json.hpp>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
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

// The last one that was made of those of the process; null: there is none.
InputRecorder* innermost() {
  InputRecorder* last = nullptr;
  for (InputRecorder* one : recorders()) {
    if (one->is_of_process()) last = one;
  }
  return last;
}

std::vector<InputFile> files_of_innermost() {
  const InputRecorder* last = nullptr;
  {
    const std::lock_guard<std::mutex> lock(list_mutex());
    last = innermost();
  }
  return last != nullptr ? last->files() : std::vector<InputFile>();
}

// Whether its contents are to stay. A pipe ends when it was read, and a capture that is being
// written, whose writer holds a lock, grows.
bool is_settled(const std::filesystem::path& path) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) return false;
  const int fd = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (fd < 0) return true;
  const bool is_held = ::flock(fd, LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  ::close(fd);
  return !is_held;
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

// What follows holds list_mutex().
struct InputRecords {
  // Those that count what this thread reads.
  static std::vector<InputRecorder*> listening() {
    std::vector<InputRecorder*> all = recorders();
    std::erase_if(all, [](const InputRecorder* one) {
      return one->thread_ != nullptr && one->thread_ != this_thread();
    });
    return all;
  }

  // Whether one that refuses changes has read this file, last with other contents than these.
  static bool is_known_otherwise(const std::string& path, const std::string& sha256) {
    for (const InputRecorder* one : listening()) {
      const bool is_judge = !one->is_of_process() || one == innermost();
      if (!is_judge || one->accepts_changes_ || one->written_.count(path) > 0) continue;
      const auto last = std::find_if(one->files_.rbegin(), one->files_.rend(),
                                     [&](const InputFile& file) { return file.path == path; });
      if (last != one->files_.rend() && last->sha256 != sha256) return true;
    }
    return false;
  }

  static void add(const std::string& path, const std::string& sha256) {
    for (InputRecorder* one : listening()) {
      const bool is_known = std::any_of(
          one->files_.begin(), one->files_.end(),
          [&](const InputFile& file) { return file.path == path && file.sha256 == sha256; });
      if (!is_known) one->files_.push_back({path, sha256});
    }
  }

  static void note(const std::string& path, const std::string& note) {
    for (InputRecorder* one : recorders()) {
      for (InputFile& file : one->files_) {
        if (file.path != path || file.note.find(note) != std::string::npos) continue;
        file.note += (file.note.empty() ? "" : "; ") + note;
      }
    }
  }

  static void add_written(const std::string& path) {
    for (InputRecorder* one : recorders()) one->written_.insert(path);
  }

  static void accept_changes() {
    if (InputRecorder* const last = innermost()) last->accepts_changes_ = true;
  }
};

void record_input_sum(const std::filesystem::path& path, const std::string& sha256) {
  const std::lock_guard<std::mutex> lock(list_mutex());
  if (InputRecords::is_known_otherwise(path.string(), sha256) && is_settled(path)) {
    throw InputChanged(path.string() + " changed while viscard was working; start again");
  }
  InputRecords::add(path.string(), sha256);
}

void refuse_lost_input(const std::filesystem::path& path, const std::string& why) {
  const std::lock_guard<std::mutex> lock(list_mutex());
  if (!InputRecords::is_known_otherwise(path.string(), "")) return;
  throw InputChanged(path.string() + " was read before and cannot be read now (" + why +
                     "); start again");
}

void note_input(const std::filesystem::path& path, const std::string& note) {
  const std::lock_guard<std::mutex> lock(list_mutex());
  InputRecords::note(path.string(), note);
}

void note_output(const std::filesystem::path& path) {
  const std::lock_guard<std::mutex> lock(list_mutex());
  InputRecords::add_written(path.string());
}

void accept_changed_inputs() {
  const std::lock_guard<std::mutex> lock(list_mutex());
  InputRecords::accept_changes();
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
