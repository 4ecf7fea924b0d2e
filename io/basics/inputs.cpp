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

// The innards of recorders; the caller holds list_mutex().
struct InputRecords {
  static bool sees_this_thread(const InputRecorder& one) {
    const Numbers& numbers = recorders_of_thread();
    return one.of_ == InputRecorder::Of::kProcess ||
           std::find(numbers.begin(), numbers.end(), one.number_) != numbers.end();
  }

  // Those that count what this thread reads.
  static std::vector<InputRecorder*> listening() {
    std::vector<InputRecorder*> all = recorders();
    std::erase_if(all, [](const InputRecorder* one) { return !sees_this_thread(*one); });
    return all;
  }

  // The last one that was made for a command; null: there is none.
  static InputRecorder* innermost() {
    InputRecorder* last = nullptr;
    for (InputRecorder* one : listening()) {
      if (one->of_ != InputRecorder::Of::kPart) last = one;
    }
    return last;
  }

  static const InputFile* last_read(const InputRecorder& one, const std::string& path) {
    const auto last = std::find_if(one.files_.rbegin(), one.files_.rend(),
                                   [&](const InputFile& file) { return file.path == path; });
    return last == one.files_.rend() ? nullptr : &*last;
  }

  // Whether one that refuses changes has read this file, last with other contents than these.
  static bool is_known_otherwise(const std::string& path, const std::string& sha256) {
    const InputRecorder* const of_command = innermost();
    for (const InputRecorder* one : listening()) {
      const bool is_judge = one->of_ != InputRecorder::Of::kProcess || one == of_command;
      if (!is_judge || one->accepts_changes_ || one->written_.count(path) > 0) continue;
      const InputFile* const last = last_read(*one, path);
      if (last != nullptr && last->sha256 != sha256) return true;
    }
    return false;
  }

  static void add(const std::string& path, const std::string& sha256) {
    for (InputRecorder* one : listening()) {
      const auto known = std::find_if(
          one->files_.begin(), one->files_.end(),
          [&](const InputFile& file) { return file.path == path && file.sha256 == sha256; });
      if (known == one->files_.end()) {
        one->files_.push_back({path, sha256});
      } else {
        std::rotate(known, known + 1, one->files_.end());
      }
    }
  }

  static void note(const std::string& path, const std::string& note) {
    for (InputRecorder* one : listening()) {
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

namespace {

std::vector<InputFile> files_of_innermost() {
  const InputRecorder* last = nullptr;
  {
    const std::lock_guard<std::mutex> lock(list_mutex());
    last = InputRecords::innermost();
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
  write_paths_of(files);
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
  if (InputRecords::is_known_otherwise(path.string(), sha256) && is_settled(path)) {
    throw InputChanged(path.string() + " changed while viscard was working; start again");
  }
  InputRecords::add(path.string(), sha256);
}

void refuse_lost_input(const std::filesystem::path& path, const std::string& why) {
  std::error_code ignored;
  const auto kind = std::filesystem::status(path, ignored).type();
  if (kind == std::filesystem::file_type::fifo) return;  // ends when it was read
  const std::lock_guard<std::mutex> lock(list_mutex());
  if (!InputRecords::is_known_otherwise(path.string(), "")) return;
  throw InputChanged(path.string() + " was read before and cannot be read now (" + why +
                     "); start again");
}

std::optional<std::string> recorded_sum(const std::filesystem::path& path) {
  const std::lock_guard<std::mutex> lock(list_mutex());
  for (auto one = recorders().rbegin(); one != recorders().rend(); ++one) {
    if (!InputRecords::sees_this_thread(**one)) continue;
    if (const InputFile* last = InputRecords::last_read(**one, path.string())) return last->sha256;
  }
  return std::nullopt;
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
                             const std::string& table, bool is_plausible_off) {
  nlohmann::ordered_json json = {{"schema", "viscard-inputs/1"},
                                 {"created_by", program_with_version()},
                                 {"is_recorded", is_recorded},
                                 {"table_sha256", sha256_of_text(table)},
                                 {"files", nlohmann::ordered_json::array()}};
  if (is_plausible_off) json["plausible"] = "off";
  for (const InputFile& file : files) {
    json["files"].push_back({{"path", written_path(file.path)}, {"sha256", file.sha256}});
    if (!file.note.empty()) json["files"].back()["note"] = written_text(file.note);
  }
  return printable_text_from_json(json, 2) + "\n";
}

}  // namespace viscard
