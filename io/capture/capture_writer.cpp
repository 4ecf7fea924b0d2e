#include "io/basics/number_text.h"
#include "io/basics/output_name.h"
#include "io/capture/capture_database.h"
#include "io/capture/capture_file.h"
#include "io/capture/capture_lock.h"
#include "io/capture/cut_watch.h"
#include "io/capture/side_file_check.h"
#include "io/capture/sync_schedule.h"
#include "models/maths/failure_text.h"

#include <sys/statvfs.h>

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

namespace viscard {
namespace {

// Throws std::runtime_error if the disk of this file has less room than a capture needs.
void refuse_full_disk(const std::filesystem::path& path, std::size_t needed_bytes) {
  const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
  struct statvfs disk {};
  if (statvfs(folder.c_str(), &disk) != 0) return;
  const auto free_bytes = static_cast<std::size_t>(disk.f_bavail) * disk.f_frsize;
  if (free_bytes >= needed_bytes) return;
  throw std::runtime_error(path.string() + ": only " + std::to_string(free_bytes >> 20) +
                           " MiB are left on that disk; a capture needs at least " +
                           std::to_string(needed_bytes >> 20) + " MiB. Make room first");
}

using Clock = std::chrono::steady_clock;

constexpr std::size_t kMaxQueuedBytes = 64u << 20;  // of raw bytes that wait for the disk

constexpr double kLookInterval_s = 0.3;  // a deleted file is noticed within a second

// The file is no longer under its name, or not all of it is there.
class FileIsGone : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

double now_s() {
  return std::chrono::duration<double>(Clock::now().time_since_epoch()).count();
}

double host_time_s(const RunRecord& record) {
  if (const auto* move = std::get_if<CommandedMove>(&record)) return move->move.start_time_s;
  return std::visit(
      [](const auto& one) {
        if constexpr (requires { one.host_time_s; }) return one.host_time_s;
        return 0.0;
      },
      record);
}

// Events are few and explain the other records: they are synced at once and never dropped.
bool is_event(const RunRecord& record) {
  return std::holds_alternative<RunEvent>(record);
}

std::size_t raw_size(const RunRecord& record) {
  const auto* raw = std::get_if<RawBytes>(&record);
  return raw == nullptr ? 0 : raw->bytes.size();
}

}  // namespace

class CaptureWriter::Impl {
 public:
  Impl(std::filesystem::path path, const CapturedRun& about, const CaptureOptions& options)
      : path_(std::move(path)),
        options_(options),
        cut_watch_(path_),
        schedule_(options.sync_interval_s, options.commit_interval_s, now_s()) {
    refuse_full_disk(path_, options.min_free_bytes);
    lock_.emplace(path_, options.overwrite, options.rights);
    try {
      database_.emplace(path_, about);
    } catch (...) {
      database_.reset();
      std::error_code ignored;
      for (const char* part : kDatabaseParts) {
        std::filesystem::remove(path_.string() + part, ignored);
      }
      throw;
    }
    thread_ = std::thread([this] { work(); });
  }

  ~Impl() {
    try {
      finish("interrupted");
    } catch (const std::exception&) {
      // append() has thrown the error already; the file reads as interrupted.
    }
  }

  void append(const RunRecord& record) {
    const std::lock_guard<std::mutex> lock(mutex_);
    throw_if_failed();
    if (is_ending_) throw std::logic_error(path_.string() + ": the capture is finished already");
    const bool is_full =
        queue_.size() >= options_.queue_capacity || queued_bytes_ > kMaxQueuedBytes;
    if (is_full && !is_event(record)) {
      if (gap_records_ == 0) gap_from_s_ = host_time_s(record);
      gap_to_s_ = host_time_s(record);
      ++gap_records_;
      ++counts_.dropped;
      return;
    }
    queued_bytes_ += raw_size(record);
    queue_.push_back(record);
    ++counts_.appended;
    if (is_event(record)) {
      wants_sync_ = true;
      wake_.notify_one();
    }
  }

  void sync() {
    std::unique_lock<std::mutex> lock(mutex_);
    const std::size_t wanted = counts_.appended;
    wants_sync_ = true;
    wake_.notify_one();
    synced_.wait(lock, [&] { return counts_.synced >= wanted || !error_.empty() || is_ended_; });
    throw_if_failed();
  }

  void finish(const std::string& status) {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (!is_ending_) final_status_ = status;
      is_ending_ = true;
      wake_.notify_one();
    }
    if (thread_.joinable()) thread_.join();
    const std::lock_guard<std::mutex> lock(mutex_);
    throw_if_failed();
  }

  CaptureCounts counts() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return counts_;
  }

 private:
  void throw_if_failed() const {
    if (!error_.empty()) throw std::runtime_error(error_);
  }

  void work() {
    try {
      while (write_once()) {
      }
      refuse_lost_file();
      refuse_cut_log();
      database_->finish(final_status_);
    } catch (const FileIsGone& gone) {
      const std::lock_guard<std::mutex> lock(mutex_);
      error_ = gone.what();
    } catch (const std::exception& error) {
      const std::lock_guard<std::mutex> lock(mutex_);
      error_ = failure_text(error, "writing " + path_.string()) +
               "; the capture stops here, and the " + std::to_string(counts_.committed) +
               " records committed before are in the file";
    }
    database_.reset();
    lock_->release();
    const std::lock_guard<std::mutex> lock(mutex_);
    is_ended_ = true;
    synced_.notify_all();
  }

  // Records in a file without a name are lost when this process ends, so the run must not go on.
  void refuse_lost_file() {
    const std::string why = lock_->why_gone();
    if (why.empty()) return;
    const std::string name = path_.string();
    const bool is_moved = why.rfind("was moved", 0) == 0;
    throw FileIsGone(name + " " + why + " while the run was writing it; the capture stops here. " +
                     (is_moved ? "What was recorded is in that file together with " + name +
                                     "-wal: give both the same name again before reading it"
                               : "What was recorded is lost; repeat the run"));
  }

  // What is missing in the files cannot be written again, so the run must not end as finished.
  void refuse_cut_files() {
    const CutWatch::Finding found = cut_watch_.look();
    if (found.loss == CutWatch::Loss::kNone) return;
    refuse_lost_file();  // the log goes with its file
    refuse_damage(found.text, found.loss == CutWatch::Loss::kCut);
  }

  // A log that was cut between two looks has grown again since, with a hole.
  void refuse_cut_log() {
    refuse_cut_files();
    const std::string log = path_.string() + "-wal";
    const SideFileCheck check = check_side_file(log);
    if (!check.damage.empty() || check.is_torn) refuse_damage(log + " was changed", true);
  }

  // When SQLite closes the file it merges the log into it. From the log as it has it open, that saves
  // what it can; from a log with a hole it would spoil the file.
  void refuse_damage(const std::string& what, bool keeps_log) {
    if (keeps_log) database_->leave_log_as_it_is();
    throw FileIsGone(what +
                     " while the run was writing it; the capture stops here. Part of what was "
                     "recorded may be lost: see what is left with viscard export --verify, and "
                     "repeat the run");
  }

  // Commits the queued records; false after the last batch of a run that has ended.
  bool write_once() {
    bool is_synced = false, is_last = false;
    std::size_t appended = 0;
    double begun_s = 0.0;
    batch_.clear();
    {
      std::unique_lock<std::mutex> lock(mutex_);
      wake_.wait_for(lock, std::chrono::duration<double>(options_.commit_interval_s),
                     [&] { return is_ending_ || wants_sync_; });
      is_last = is_ending_;
      appended = counts_.appended;
      begun_s = now_s();
      is_synced =
          wants_sync_ || is_last || (schedule_.is_due(begun_s) && counts_.synced < appended);
      wants_sync_ = false;
      std::swap(batch_, queue_);
      queued_bytes_ = 0;
      if (gap_records_ > 0) batch_.push_back(gap_event());
    }
    if (!batch_.empty() || is_synced) {
      refuse_cut_files();
      database_->write(batch_, is_synced);
      refuse_cut_files();
    }
    if (is_synced) schedule_.synced(begun_s, now_s());
    if (now_s() - looked_s_ > kLookInterval_s) {
      looked_s_ = now_s();
      refuse_lost_file();
    }
    const std::lock_guard<std::mutex> lock(mutex_);
    counts_.committed = appended;
    if (is_synced) counts_.synced = appended;
    synced_.notify_all();
    return !is_last;
  }

  // Precondition: the mutex is locked.
  RunEvent gap_event() {
    RunEvent event{gap_to_s_, "gap", std::to_string(gap_records_),
                   std::to_string(gap_records_) + " records between " +
                       text_from_number(gap_from_s_) + " s and " + text_from_number(gap_to_s_) +
                       " s were lost because the disk did not keep up"};
    gap_records_ = 0;
    return event;
  }

  const std::filesystem::path path_;
  const CaptureOptions options_;
  std::optional<CaptureLock> lock_;  // before the database, which must be closed first
  std::optional<CaptureDatabase> database_;
  std::vector<RunRecord> batch_;
  CutWatch cut_watch_;
  SyncSchedule schedule_;
  double looked_s_ = 0.0;  // when the file was last looked for under its name

  mutable std::mutex mutex_;  // guards everything below
  std::condition_variable wake_, synced_;
  std::vector<RunRecord> queue_;
  std::size_t queued_bytes_ = 0;
  CaptureCounts counts_;
  std::size_t gap_records_ = 0;
  double gap_from_s_ = 0.0, gap_to_s_ = 0.0;
  bool wants_sync_ = false;
  bool is_ending_ = false;
  bool is_ended_ = false;
  std::string final_status_;
  std::string error_;
  std::thread thread_;
};

CaptureWriter::CaptureWriter(const std::filesystem::path& path, const CapturedRun& about,
                             const CaptureOptions& options)
    : impl_(std::make_unique<Impl>(path, about, options)) {}
CaptureWriter::~CaptureWriter() = default;
void CaptureWriter::append(const RunRecord& record) {
  impl_->append(record);
}
void CaptureWriter::sync() {
  impl_->sync();
}
void CaptureWriter::finish(const std::string& status) {
  impl_->finish(status);
}
CaptureCounts CaptureWriter::counts() const {
  return impl_->counts();
}

}  // namespace viscard
