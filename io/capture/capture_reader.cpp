#include "io/capture/capture_database.h"
#include "io/capture/capture_file.h"
#include "io/capture/capture_lock.h"
#include "io/capture/sqlite_database.h"
#include "io/config/config_file.h"

#include <fcntl.h>
#include <sqlite3.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <unordered_set>

namespace viscard {
namespace {

namespace fs = std::filesystem;

// First 100 bytes of an SQLite file, numbers big-endian:
// https://www.sqlite.org/fileformat2.html 1.3
using Header = std::array<unsigned char, 100>;
constexpr std::string_view kMagic{"SQLite format 3\0", 16};

std::uint32_t big_endian(const Header& header, std::size_t from, std::size_t size) {
  std::uint32_t value = 0;
  for (std::size_t i = from; i < from + size; ++i) value = value << 8 | header[i];
  return value;
}

[[noreturn]] void fail(const fs::path& path, const std::string& what) {
  throw std::runtime_error(path.string() + " " + what);
}

// Reads with read(2), because a stream does not report why it fails.
std::size_t read_header(const fs::path& path, Header& header) {
  const int fd = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY);
  if (fd < 0) throw std::runtime_error(path.string() + ": cannot open: " + std::strerror(errno));
  const ssize_t count = ::read(fd, header.data(), header.size());
  ::close(fd);
  return count < 0 ? 0 : static_cast<std::size_t>(count);
}

bool has_magic(const Header& header, std::size_t size) {
  return size >= kMagic.size() && std::memcmp(header.data(), kMagic.data(), kMagic.size()) == 0;
}

bool has_journal(const fs::path& path) {
  std::error_code ignored;
  const auto size = fs::file_size(path.string() + "-wal", ignored);
  return !ignored && size > 0;
}

// Checks the first bytes and the size, because SQLite's own messages would not help a user.
void check_header(const fs::path& path) {
  if (fs::is_directory(path)) fail(path, "is a folder; name the capture file in it");
  Header header{};
  const std::size_t size = read_header(path, header);
  if (size == 0)
    fail(path, "is empty: the capture ended before it wrote anything; there is nothing to read");
  if (!has_magic(header, size)) fail(path, "is not a capture (a *.viscap file begins otherwise)");
  if (size < header.size())
    fail(path, "is truncated: its header is not complete; use a copy of it");
  if (big_endian(header, 68, 4) != kCaptureApplicationId) {
    fail(path, "is an SQLite database of another program, not a capture");
  }
  const std::uint32_t version = big_endian(header, 60, 4);
  if (version > kCaptureSchemaVersion) {
    fail(path, "was written by a newer viscard (schema " + std::to_string(version) +
                   ", this one reads up to " + std::to_string(kCaptureSchemaVersion) +
                   "); update viscard");
  }
  // With a journal beside it, the main file may be shorter than its header states.
  const std::uint64_t page = big_endian(header, 16, 2) == 1 ? 65536 : big_endian(header, 16, 2);
  const std::uint64_t expected = page * big_endian(header, 28, 4);
  if (!has_journal(path) && fs::file_size(path) < expected) {
    fail(path, "is truncated: " + std::to_string(fs::file_size(path)) + " of " +
                   std::to_string(expected) +
                   " bytes are there; use a whole copy, or save what is left with: sqlite3 " +
                   path.string() + " .recover");
  }
}

// A capture opened for reading. SQLite needs to create a side file to read a journal, so on a
// read-only medium a copy is read.
class OpenCapture {
 public:
  explicit OpenCapture(const fs::path& path) : path_(path) {
    check_header(path);
    is_running_ = is_being_captured(path);
    try {
      database_.emplace(path, Database::Access::kReadOnly);
      database_->text_of("SELECT count(*) FROM sqlite_schema");
    } catch (const SqliteError& error) {
      if (error.code() != SQLITE_CANTOPEN && error.code() != SQLITE_READONLY) explain(error);
      open_copy();
    }
  }
  ~OpenCapture() {
    database_.reset();
    std::error_code ignored;
    if (!copy_.empty()) fs::remove_all(copy_, ignored);
  }
  OpenCapture(const OpenCapture&) = delete;
  OpenCapture& operator=(const OpenCapture&) = delete;

  Database& database() { return *database_; }
  bool is_running() const { return is_running_; }

  [[noreturn]] void explain(const SqliteError& error) const {
    if (error.code() == SQLITE_CORRUPT || error.code() == SQLITE_NOTADB) {
      fail(path_, "is damaged; use another copy of it, or save what is left with: sqlite3 " +
                      path_.string() + " .recover");
    }
    throw std::runtime_error(error.what());
  }

 private:
  void open_copy() {
    std::string folder = (fs::temp_directory_path() / "viscard-XXXXXX").string();
    if (::mkdtemp(folder.data()) == nullptr) {
      throw std::runtime_error(folder + ": cannot create: " + std::strerror(errno));
    }
    copy_ = folder;
    const fs::path file = copy_ / "copy.viscap";
    fs::copy_file(path_, file);
    if (has_journal(path_)) fs::copy_file(path_.string() + "-wal", file.string() + "-wal");
    database_.emplace(file, Database::Access::kReadWrite);
  }

  fs::path path_, copy_;
  std::optional<Database> database_;
  bool is_running_ = false;
};

std::string run_value(Database& database, const char* key) {
  Statement statement = database.prepare("SELECT value FROM run WHERE key = ?");
  statement.bind(1, std::string_view(key));
  return statement.step() ? statement.text(0) : std::string();
}

void read_samples(Database& database, CapturedRun& run) {
  const bool has_force = database.text_of("PRAGMA user_version") != "1";
  const std::string columns =
      "SELECT sample_index, host_time_s, device_time_s, counts, volts, is_saturated, is_glitch, ";
  const std::string from = " FROM load_samples ORDER BY seq";
  Statement row = database.prepare((columns + (has_force ? "force_N" : "NULL") + from).c_str());
  while (row.step()) {
    run.load_samples.push_back({row.integer(0), row.number(1), row.maybe_number(2),
                                row.maybe_number(3), row.maybe_number(4), row.integer(5) != 0,
                                row.integer(6) != 0, row.maybe_number(7)});
  }
}

void read_stage(Database& database, CapturedRun& run) {
  Statement report =
      database.prepare("SELECT host_time_s, position_m, state FROM stage_reports ORDER BY seq");
  while (report.step()) {
    run.stage_reports.push_back({report.number(0), report.number(1), report.text(2)});
  }
  Statement move = database.prepare(
      "SELECT start_time_s, from_m, to_m, speed_m_s, acceleration_m_s2, start_uncertainty_s, "
      "purpose FROM moves ORDER BY seq");
  while (move.step()) {
    run.moves.push_back(
        {{move.number(0), move.number(1), move.number(2), move.number(3), move.number(4)},
         move.number(5),
         move.text(6)});
  }
}

void read_events(Database& database, CapturedRun& run) {
  Statement event =
      database.prepare("SELECT host_time_s, name, value, text FROM events ORDER BY seq");
  while (event.step()) {
    run.events.push_back({event.number(0), event.text(1), event.text(2), event.text(3)});
  }
}

void read_metadata(Database& database, const fs::path& path, CapturedRun& run) {
  const std::string inside = path.string() + " (stored ";
  run.rig = rig_from_toml(run_value(database, "rig_toml"), inside + "rig)");
  run.plan = test_from_toml(run_value(database, "test_toml"), inside + "test)");
  run.specimen = specimen_from_toml(run_value(database, "specimen_toml"), inside + "specimen)");
  run.started_at = run_value(database, "started_at");
  run.program = run_value(database, "program");
  run.command = run_value(database, "command");
}

void read_status(OpenCapture& capture, const fs::path& path, CapturedRun& run) {
  run.status = run_value(capture.database(), "status");
  if (run.status != "open") return;
  run.status = capture.is_running() ? "running" : "interrupted";
  if (capture.is_running() || has_journal(path)) return;
  run.events.push_back({run.events.empty() ? 0.0 : run.events.back().host_time_s, "gap", "",
                        "the run was interrupted and its side file " + path.string() +
                            "-wal is missing; if only the main file was copied, the last "
                            "seconds may be in that side file"});
}

// Readings whose index an event "implausible" names count as glitches. The event comes after the
// reading was recorded.
void mark_implausible(CapturedRun& run) {
  std::unordered_set<std::string> indices;
  for (const RunEvent& event : run.events) {
    if (event.name == "implausible") indices.insert(event.value);
  }
  if (indices.empty()) return;
  for (LoadSample& sample : run.load_samples) {
    if (indices.count(std::to_string(sample.index)) > 0) sample.is_glitch = true;
  }
}

}  // namespace

CapturedRun read_capture(const std::filesystem::path& path) {
  OpenCapture capture(path);
  Database& database = capture.database();
  CapturedRun run;
  try {
    database.execute("BEGIN");  // one snapshot, even of a run that is still being written
    if (database.text_of("PRAGMA quick_check(1)") != "ok") {
      throw SqliteError(path.string(), SQLITE_CORRUPT);
    }
    read_metadata(database, path, run);
    read_samples(database, run);
    read_stage(database, run);
    read_events(database, run);
    mark_implausible(run);
    run.n_raw_bytes = static_cast<std::size_t>(
        std::stoull("0" + database.text_of("SELECT sum(length(bytes)) FROM raw_bytes")));
    read_status(capture, path, run);
    database.execute("COMMIT");
  } catch (const SqliteError& error) {
    capture.explain(error);
  }
  return run;
}

void read_raw_bytes(const std::filesystem::path& path,
                    const std::function<void(const RawBytes&)>& take) {
  OpenCapture capture(path);
  try {
    Statement row = capture.database().prepare(
        "SELECT host_time_s, device, is_sent, bytes FROM raw_bytes ORDER BY seq");
    while (row.step()) {
      take({row.text(1) == "stage" ? Device::kStage : Device::kLoadCell, row.integer(2) != 0,
            row.number(0), row.text(3)});
    }
  } catch (const SqliteError& error) {
    capture.explain(error);
  }
}

bool looks_like_capture(const std::filesystem::path& path) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) return false;
  if (path.extension() == ".viscap") return true;
  Header header{};
  return has_magic(header, read_header(path, header));
}

}  // namespace viscard
