#pragma once

#include "io/capture/sqlite_database.h"
#include "models/experiment/captured_run.h"
#include "models/experiment/run_record.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace viscard {

// The tables of a capture that is being written: one connection and its prepared statements, for
// one thread at a time. All functions throw SqliteError.
class CaptureDatabase {
 public:
  // The file must exist and be empty. Stores rig, plan, specimen, program, command and started_at
  // of `about`.
  CaptureDatabase(const std::filesystem::path& path, const CapturedRun& about);

  // Writes one transaction; with is_synced it is on the medium when this returns.
  void write(const std::vector<RunRecord>& batch, bool is_synced);

  // Stores the status. Merges the journal into the main file unless a reader has the file open.
  void finish(const std::string& status);

 private:
  void create(const std::filesystem::path& path, const CapturedRun& about);
  void set(const char* key, const std::string& value);
  void insert(const RawBytes& raw);
  void insert(const LoadSample& sample);
  void insert(const StageReport& report);
  void insert(const CommandedMove& commanded);
  void insert(const RunEvent& event);

  Database database_;  // declared first, so that the statements are destroyed before it
  std::optional<Statement> raw_, sample_, report_, move_, event_, run_;
  std::int64_t seq_ = 0;
};

}  // namespace viscard
