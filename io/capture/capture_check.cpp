#include "io/capture/capture_check.h"

#include "io/basics/number_text.h"
#include "io/capture/capture_database.h"
#include "io/capture/capture_file.h"
#include "io/capture/open_capture.h"
#include "io/capture/row_checksum.h"

#include <sqlite3.h>

#include <algorithm>
#include <map>
#include <stdexcept>
#include <string_view>

namespace viscard {
namespace {

// One row of the table `checksums`.
struct StoredChecksum {
  std::string table;
  std::int64_t first_seq = 0, last_seq = 0, n_rows = 0, crc32 = 0;
};

bool is_equal(const RowChecksum& now, const StoredChecksum& stored) {
  return static_cast<std::int64_t>(now.n_rows()) == stored.n_rows &&
         static_cast<std::int64_t>(now.crc32()) == stored.crc32;
}

std::vector<StoredChecksum> stored_checksums(Database& database) {
  std::vector<StoredChecksum> stored;
  Statement row = database.prepare(
      "SELECT table_name, first_seq, last_seq, n_rows, crc32 FROM checksums ORDER BY rowid");
  while (row.step()) {
    stored.push_back({row.text(0), row.integer(1), row.integer(2), row.integer(3), row.integer(4)});
  }
  return stored;
}

bool is_record_table(const std::string& name) {
  return std::find(std::begin(kRecordTables), std::end(kRecordTables), name) !=
         std::end(kRecordTables);
}

void check_run(Database& database, const StoredChecksum& stored, CaptureCheck& check) {
  const RunPart part = stored.table == kRunStart ? RunPart::kStart : RunPart::kEnd;
  if (is_equal(checksum_of_run(database, part), stored)) return;
  check.faults.push_back(
      part == RunPart::kStart
          ? "the description of the run (rig, test, specimen, start) is not what "
            "was written"
          : "the end of the run (status, times) is not what was written");
}

void check_batch(Database& database, const StoredChecksum& stored, CaptureCheck& check) {
  ++check.n_batches;
  const RowChecksum now =
      checksum_of_rows(database, stored.table, stored.first_seq, stored.last_seq);
  check.n_records += now.n_rows();
  if (is_equal(now, stored)) return;
  check.faults.push_back("table " + stored.table + ", records " + std::to_string(stored.first_seq) +
                         " to " + std::to_string(stored.last_seq) + ": not what was written (" +
                         std::to_string(now.n_rows()) + " of " + std::to_string(stored.n_rows) +
                         " rows are there)");
}

void check_all(Database& database, CaptureCheck& check) {
  std::map<std::string, std::int64_t> n_covered;
  bool has_start = false, has_end = false;
  for (const StoredChecksum& stored : stored_checksums(database)) {
    has_start = has_start || stored.table == kRunStart;
    has_end = has_end || stored.table == kRunEnd;
    if (stored.table == kRunStart || stored.table == kRunEnd) {
      check_run(database, stored, check);
    } else if (is_record_table(stored.table)) {
      n_covered[stored.table] += stored.n_rows;
      check_batch(database, stored, check);
    } else {
      check.faults.push_back("the table of checksums is damaged: it names " + stored.table);
    }
  }
  const bool has_temperatures =
      std::stoul("0" + database.text_of("PRAGMA user_version")) >= kFirstSchemaWithTemperatures;
  for (const char* table : kRecordTables) {
    if (!has_temperatures && std::string_view(table) == "temperatures") continue;
    const std::string count = "SELECT count(*) FROM " + std::string(table);
    if (database.text_of(count.c_str()) == std::to_string(n_covered[table])) continue;
    check.faults.push_back("table " + std::string(table) + " holds " +
                           database.text_of(count.c_str()) + " rows, but checksums of " +
                           std::to_string(n_covered[table]));
  }
  const bool is_open = database.text_of("SELECT value FROM run WHERE key = 'status'") == "open";
  if (!has_start || has_end == is_open) {
    check.faults.push_back("the checksum of the start or of the end of the run is missing");
  }
}

}  // namespace

CaptureCheck check_capture(const std::filesystem::path& path) {
  OpenCapture capture(path);
  Database& database = capture.database();
  CaptureCheck check;
  try {
    database.execute("BEGIN");
    if (database.text_of("PRAGMA integrity_check(1)") != "ok") {
      throw SqliteError(path.string(), SQLITE_CORRUPT);
    }
    const bool has_table =
        !database.text_of("SELECT name FROM sqlite_schema WHERE name = 'checksums'").empty();
    const bool is_recent =
        std::stoul("0" + database.text_of("PRAGMA user_version")) >= kFirstSchemaWithChecksums;
    check.is_checked = has_table || is_recent;
    if (has_table != is_recent) {
      check.faults.push_back("the number of its schema does not fit its tables");
    }
    if (has_table) check_all(database, check);
    database.execute("COMMIT");
  } catch (const SqliteError& error) {
    capture.explain(error);
  }
  // The checksums cover the records and not the names of tables and columns.
  try {
    read_capture(path);
  } catch (const std::runtime_error& error) {
    check.faults.emplace_back(error.what());
  }
  return check;
}

}  // namespace viscard
