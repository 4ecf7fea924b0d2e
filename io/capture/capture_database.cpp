#include "io/capture/capture_database.h"

#include "io/basics/number_text.h"
#include "io/basics/program.h"
#include "io/basics/timestamp.h"
#include "io/config/config_file.h"

#include <sqlite3.h>
#include <time.h>

#include <fstream>
#include <stdexcept>
#include <string_view>

namespace viscard {
namespace {

double clock_s(clockid_t clock) {
  timespec now{};
  clock_gettime(clock, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

std::string first_line_of(const char* path) {
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  return line;
}

std::string boot_id() {
  return first_line_of("/proc/sys/kernel/random/boot_id");
}

// Different for every run, also for two that begin within one second.
std::string new_run_id() {
  return first_line_of("/proc/sys/kernel/random/uuid");
}

}  // namespace

unsigned long schema_of(Database& database) {
  return std::stoul("0" + database.text_of("PRAGMA user_version"));
}

CaptureDatabase::CaptureDatabase(const std::filesystem::path& path, const CapturedRun& about)
    : database_(path, Database::Access::kReadWrite) {
  create(path, about);
  raw_.emplace(database_.prepare("INSERT INTO raw_bytes VALUES(?,?,?,?,?)"));
  sample_.emplace(database_.prepare("INSERT INTO load_samples VALUES(?,?,?,?,?,?,?,?,?)"));
  report_.emplace(database_.prepare("INSERT INTO stage_reports VALUES(?,?,?,?)"));
  move_.emplace(database_.prepare("INSERT INTO moves VALUES(?,?,?,?,?,?,?,?)"));
  event_.emplace(database_.prepare("INSERT INTO events VALUES(?,?,?,?,?)"));
  temperature_.emplace(database_.prepare("INSERT INTO temperatures VALUES(?,?,?)"));
  run_.emplace(database_.prepare("INSERT OR REPLACE INTO run VALUES(?,?)"));
  checksum_.emplace(database_.prepare("INSERT INTO checksums VALUES(?,?,?,?,?)"));
  identity_.emplace(database_.prepare("UPDATE identity SET n_transactions = n_transactions + 1"));
}

void CaptureDatabase::write(const std::vector<RunRecord>& batch, bool is_synced) {
  if (is_synced) database_.execute("PRAGMA synchronous=FULL");
  database_.execute("BEGIN");
  const std::int64_t first_seq = seq_ + 1;
  for (const RunRecord& record : batch) {
    ++seq_;
    std::visit([this](const auto& one) { insert(one); }, record);
  }
  if (seq_ >= first_seq) store_checksums_from(first_seq);
  // With an empty batch this makes the transaction that is synced.
  if (is_synced) set(kSyncedCount, std::to_string(seq_));
  identity_->run_with();
  database_.execute("COMMIT");
  if (is_synced) database_.execute("PRAGMA synchronous=NORMAL");
}

void CaptureDatabase::finish(const std::string& status) {
  // EXTRA syncs the folder after a rollback journal is removed. Otherwise the journal of the switch
  // away from WAL could return after a power cut and roll the finished file back.
  database_.execute("PRAGMA synchronous=EXTRA");
  database_.execute("BEGIN");
  set("status", status);
  set("finished_at", now_iso8601());
  set("finish_clock_monotonic_s", text_from_number(clock_s(CLOCK_MONOTONIC)));
  set("finish_clock_realtime_s", text_from_number(clock_s(CLOCK_REALTIME)));
  store_checksum(kRunEnd, seq_ + 1, checksum_of_run(database_, RunPart::kEnd));
  identity_->run_with();
  database_.execute("COMMIT");
  // From here on the run is safe. If a reader has the file open, only the side files stay.
  try {
    database_.execute("PRAGMA wal_checkpoint(TRUNCATE)");
    database_.text_of("PRAGMA journal_mode=DELETE");
  } catch (const SqliteError& error) {
    if (error.code() != SQLITE_BUSY) throw;
  }
}

// Tables and the description of the run are written before the switch to WAL, so that they are in
// the main file.
void CaptureDatabase::create(const std::filesystem::path& path, const CapturedRun& about) {
  database_.execute("PRAGMA synchronous=EXTRA");  // as in finish()
  database_.execute("BEGIN");
  database_.execute(("PRAGMA application_id=" + std::to_string(kCaptureApplicationId)).c_str());
  database_.execute(("PRAGMA user_version=" + std::to_string(kCaptureSchemaVersion)).c_str());
  database_.execute(kCaptureTables);
  run_.emplace(database_.prepare("INSERT OR REPLACE INTO run VALUES(?,?)"));
  checksum_.emplace(database_.prepare("INSERT INTO checksums VALUES(?,?,?,?,?)"));
  set("status", "open");
  set("program", about.program.empty() ? program_with_version() : about.program);
  set("command", about.command);
  set("started_at", about.started_at.empty() ? now_iso8601() : about.started_at);
  set("start_clock_monotonic_s", text_from_number(clock_s(CLOCK_MONOTONIC)));
  set("start_clock_realtime_s", text_from_number(clock_s(CLOCK_REALTIME)));
  set("boot_id", boot_id());
  database_.prepare("INSERT INTO identity VALUES(?, 0)").run_with(std::string_view(new_run_id()));
  set("rig_toml", toml_from_rig(about.rig));
  set("test_toml", toml_from_test(about.plan));
  set("specimen_toml", toml_from_specimen(about.specimen));
  store_checksum(kRunStart, seq_ + 1, checksum_of_run(database_, RunPart::kStart));
  database_.execute("COMMIT");
  run_.reset();
  checksum_.reset();
  if (database_.text_of("PRAGMA journal_mode=WAL") != "wal") {
    throw std::runtime_error(path.string() +
                             ": this disk cannot keep a write-ahead log (is it a network share?); "
                             "capture to a local disk");
  }
  database_.execute("PRAGMA synchronous=NORMAL");
}

void CaptureDatabase::store_checksum(const char* name, std::int64_t first_seq,
                                     const RowChecksum& checksum) {
  checksum_->run_with(std::string_view(name), first_seq, seq_,
                      static_cast<std::int64_t>(checksum.n_rows()),
                      static_cast<std::int64_t>(checksum.crc32()));
}

// Reads the rows back, so that writing and checking share the code that adds them up.
void CaptureDatabase::store_checksums_from(std::int64_t first_seq) {
  for (const char* table : kRecordTables) {
    const RowChecksum checksum = checksum_of_rows(database_, table, first_seq, seq_);
    if (checksum.n_rows() > 0) store_checksum(table, first_seq, checksum);
  }
}

void CaptureDatabase::set(const char* key, const std::string& value) {
  run_->run_with(std::string_view(key), std::string_view(value));
}

void CaptureDatabase::insert(const RawBytes& raw) {
  raw_->run_with(seq_, raw.host_time_s, std::string_view(word_of(raw.device)), raw.is_sent,
                 Statement::Blob{raw.bytes});
}

void CaptureDatabase::insert(const LoadSample& sample) {
  sample_->run_with(seq_, sample.index, sample.host_time_s, sample.device_time_s, sample.counts,
                    sample.volts, sample.is_saturated, sample.is_glitch, sample.force_N);
}

void CaptureDatabase::insert(const StageReport& report) {
  report_->run_with(seq_, report.host_time_s, report.position_m, std::string_view(report.state));
}

void CaptureDatabase::insert(const CommandedMove& commanded) {
  const StageMove& move = commanded.move;
  move_->run_with(seq_, move.start_time_s, move.from_m, move.to_m, move.speed_m_s,
                  move.acceleration_m_s2, commanded.start_uncertainty_s,
                  std::string_view(commanded.purpose));
}

void CaptureDatabase::insert(const RunEvent& event) {
  event_->run_with(seq_, event.host_time_s, std::string_view(event.name),
                   std::string_view(event.value), std::string_view(event.text));
}

void CaptureDatabase::insert(const TemperatureSample& sample) {
  temperature_->run_with(seq_, sample.host_time_s, sample.temperature_C);
}

}  // namespace viscard
