#pragma once

#include "io/capture/row_checksum.h"
#include "io/capture/sqlite_database.h"
#include "models/experiment/captured_run.h"
#include "models/experiment/run_record.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace viscard {

// Tables of a capture file; io/capture/README.md explains the columns. seq counts the records of
// all tables in the order of append().
inline constexpr std::uint32_t kCaptureApplicationId = 0x56434150;  // "VCAP"
inline constexpr std::uint32_t kCaptureSchemaVersion = 5;
// 2: load_samples.force_N, 3: checksums, 4: temperatures, 5: identity
inline constexpr std::uint32_t kFirstSchemaWithChecksums = 3;
inline constexpr std::uint32_t kFirstSchemaWithTemperatures = 4;
inline constexpr std::uint32_t kFirstSchemaWithIdentity = 5;

// The key in `run` that every synced transaction writes, and no other.
inline constexpr const char* kSyncedCount = "n_records_synced";

// The schema that a capture states.
unsigned long schema_of(Database& database);

inline constexpr const char* kCaptureTables = R"sql(
CREATE TABLE run(key TEXT PRIMARY KEY, value TEXT NOT NULL) WITHOUT ROWID;
CREATE TABLE raw_bytes(seq INTEGER PRIMARY KEY, host_time_s REAL, device TEXT, is_sent INTEGER,
                       bytes BLOB);
CREATE TABLE load_samples(seq INTEGER PRIMARY KEY, sample_index INTEGER, host_time_s REAL,
                          device_time_s REAL, counts REAL, volts REAL, is_saturated INTEGER,
                          is_glitch INTEGER, force_N REAL);
CREATE TABLE stage_reports(seq INTEGER PRIMARY KEY, host_time_s REAL, position_m REAL, state TEXT);
CREATE TABLE moves(seq INTEGER PRIMARY KEY, start_time_s REAL, from_m REAL, to_m REAL,
                   speed_m_s REAL, acceleration_m_s2 REAL, start_uncertainty_s REAL, purpose TEXT);
CREATE TABLE events(seq INTEGER PRIMARY KEY, host_time_s REAL, name TEXT, value TEXT, text TEXT);
CREATE TABLE temperatures(seq INTEGER PRIMARY KEY, host_time_s REAL, temperature_C REAL);
CREATE TABLE checksums(table_name TEXT, first_seq INTEGER, last_seq INTEGER, n_rows INTEGER,
                       crc32 INTEGER);
CREATE TABLE identity(run_id TEXT, n_transactions INTEGER);
)sql";

// The tables of a capture that is being written: one connection and its prepared statements, for
// one thread at a time. All functions throw SqliteError.
class CaptureDatabase {
 public:
  // The file must exist and be empty. Stores rig, plan, specimen, program, command and started_at
  // of `about`.
  CaptureDatabase(const std::filesystem::path& path, const CapturedRun& about);

  // Writes one transaction with a checksum of its rows in each table; with is_synced it is on the medium when this returns.
  void write(const std::vector<RunRecord>& batch, bool is_synced);

  // Stores the status. Merges the journal into the main file unless a reader has the file open.
  void finish(const std::string& status);

  // Closing the file will not merge the log into it.
  void leave_log_as_it_is() { database_.leave_log_as_it_is(); }

 private:
  void create(const std::filesystem::path& path, const CapturedRun& about);
  void store_checksum(const char* name, std::int64_t first_seq, const RowChecksum& checksum);
  void store_checksums_from(std::int64_t first_seq);
  void set(const char* key, const std::string& value);
  void insert(const RawBytes& raw);
  void insert(const LoadSample& sample);
  void insert(const StageReport& report);
  void insert(const CommandedMove& commanded);
  void insert(const RunEvent& event);
  void insert(const TemperatureSample& sample);

  Database database_;  // declared first, so that the statements are destroyed before it
  std::optional<Statement> raw_, sample_, report_, move_, event_, temperature_, run_, checksum_,
      identity_;
  std::int64_t seq_ = 0;
};

}  // namespace viscard
