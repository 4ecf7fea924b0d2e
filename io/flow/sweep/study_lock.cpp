#include "io/flow/sweep/study_lock.h"

#include "io/basics/missing_file.h"
#include "io/basics/output_name.h"
#include "io/capture/capture_header.h"
#include "io/capture/sqlite_database.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <stdexcept>
#include <utility>

namespace viscard {

void refuse_other_file(const std::filesystem::path& path) {
  const bool is_capture = looks_like_capture(path) && path.extension() == ".viscap";
  throw std::runtime_error(
      path.string() +
      (is_capture ? " is a capture" : " is an SQLite database, but not the points of a study") +
      "; it was not changed. Name another file with --out");
}

// SQLite keeps the last rows beside the name by which a file was opened, so another name lacks
// them, and a store that is opened by it loses them.
void refuse_second_name(const std::filesystem::path& path) {
  std::error_code ignored;
  const auto n_names = std::filesystem::hard_link_count(path, ignored);
  if (ignored || n_names < 2 || !std::filesystem::is_regular_file(path, ignored)) return;
  throw std::runtime_error(path.string() + ": the file has " + std::to_string(n_names) +
                           " names (hard links), by which its points would be lost; copy it (cp) "
                           "and name the copy, or remove the other names");
}

// SQLite leaves files beside a database that it may only read, unless it takes it for one that nobody changes. One
// that is in use, or was left by a killed program, has its log beside it.
Database opened_to_look(const std::filesystem::path& path) {
  const auto has = [&](const char* ending) {
    return std::filesystem::exists(path.string() + ending);
  };
  const bool has_log = has("-wal") || has("-journal");
  return {path, has_log ? Database::Access::kReadOnly : Database::Access::kMainFileOnly};
}

// Looks into an existing file without changing it.
void refuse_other_kind(const std::filesystem::path& path) {
  if (std::filesystem::is_directory(path)) {
    throw std::runtime_error(path.string() + ": is a folder; name a file in it, such as " +
                             (path / "points.sqlite").string());
  }
  refuse_output_name(path);
  refuse_orphaned_log(path, "sweep");
  std::error_code ignored;
  if (!std::filesystem::exists(path) || std::filesystem::file_size(path, ignored) == 0) return;
  Database database = opened_to_look(path);
  if (database.text_of("PRAGMA application_id") != "0") refuse_other_file(path);
  const std::string n_tables = database.text_of("SELECT count(*) FROM sqlite_schema");
  const std::string n_own = database.text_of(
      "SELECT count(*) FROM sqlite_schema WHERE type = 'table' AND name IN ('study', 'points')");
  if (!database.first_foreign_object().empty()) refuse_other_file(path);
  // A file without any table is a store that is just being made.
  if (n_tables == "0" ? database.text_of("PRAGMA user_version") != "0" : n_own != "2")
    refuse_other_file(path);
  if (n_tables == "0") return;
  const std::string n_columns = database.text_of(
      "SELECT (SELECT count(*) FROM pragma_table_info('study') WHERE name = 'fingerprint') + "
      "(SELECT count(*) FROM pragma_table_info('points') WHERE name IN ('point', 'parameters', "
      "'results', 'failure'))");
  if (n_columns != "5") refuse_other_file(path);
}

StudyLock::StudyLock(std::filesystem::path path, std::function<void(const std::string&)> on_gone,
                     double waits_s)
    : path_(std::move(path)), on_gone_(std::move(on_gone)) {
  refuse_second_name(path_);
  refuse_other_kind(path_);
  fd_ = ::open(path_.c_str(), O_RDONLY | O_CREAT | O_CLOEXEC, 0666);
  if (fd_ < 0) return;  // the store reports why
  const auto is_held = [this] {
    return ::flock(fd_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  };
  const auto until =
      std::chrono::steady_clock::now() + std::chrono::duration<double>(std::max(0.0, waits_s));
  bool is_busy = is_held();
  while (is_busy && std::chrono::steady_clock::now() < until) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    is_busy = is_held();
  }
  if (is_busy) {
    ::close(fd_);
    throw std::runtime_error(
        path_.string() +
        ": another sweep is answering its points; wait for it to end, then the same command goes "
        "on. To share the work of a study, give each a file of its own with --shard, and --merge "
        "them");
  }
  watch_ = std::jthread([this](const std::stop_token& stop) { watch(stop); });
}

StudyLock::~StudyLock() {
  watch_ = {};
  if (fd_ >= 0) ::close(fd_);
}

std::string StudyLock::why_gone() const {
  const std::string why = fd_ < 0 ? std::string() : why_file_is_gone(fd_, path_);
  if (why.empty()) return {};
  return path_.string() + " " + why + " while its points were answered; the sweep stops here" +
         (why.rfind("was moved", 0) == 0
              ? ". The points are in that file together with " + path_.string() +
                    "-wal: give both the same name again, then go on"
              : ", and the points in it are lost");
}

void StudyLock::watch(const std::stop_token& stop) {
  std::mutex mutex;
  std::condition_variable_any wake;
  std::unique_lock<std::mutex> lock(mutex);
  while (!wake.wait_for(lock, stop, std::chrono::milliseconds(300), [] { return false; })) {
    if (stop.stop_requested()) return;
    const std::string why = why_gone();
    if (why.empty()) continue;
    if (on_gone_) on_gone_(why);
    return;
  }
}

void StudyLock::check_file() const {
  const std::string why = why_gone();
  if (!why.empty()) throw std::runtime_error(why);
}

}  // namespace viscard
