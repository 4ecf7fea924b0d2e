#include "io/capture/capture_check.h"

#include "io/basics/number_text.h"
#include "io/capture/capture_database.h"
#include "io/capture/capture_file.h"
#include "io/capture/integrity_notes.h"
#include "io/capture/open_capture.h"
#include "io/capture/row_checksum.h"

#include <sqlite3.h>

#include <algorithm>
#include <iterator>
#include <limits>
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

void check_run(Database& database, const StoredChecksum& stored, CheckedRecords& records) {
  const RunPart part = stored.table == kRunStart ? RunPart::kStart : RunPart::kEnd;
  if (is_equal(checksum_of_run(database, part), stored)) return;
  records.is_description_damaged = true;
  records.check.faults.push_back(
      part == RunPart::kStart
          ? "the description of the run (rig, test, specimen, start) is not what "
            "was written"
          : "the end of the run (status, times) is not what was written");
}

void add_batch(const StoredChecksum& stored, const RowChecksum& now, CheckedRecords& records) {
  CaptureCheck& check = records.check;
  ++check.n_batches;
  check.n_records += now.n_rows();
  if (is_equal(now, stored)) {
    records.sound[stored.table].push_back({stored.first_seq, stored.last_seq});
    return;
  }
  records.damaged_tables.push_back(stored.table);
  check.faults.push_back("table " + stored.table + ", records " + std::to_string(stored.first_seq) +
                         " to " + std::to_string(stored.last_seq) + ": not what was written (" +
                         std::to_string(now.n_rows()) + " of " + std::to_string(stored.n_rows) +
                         " rows are there)");
}

// Compares the rows of one table with its checksums in one pass. Rows between the batches belong to
// none, so that their checksum is missing.
void check_table(Database& database, const std::string& table,
                 const std::vector<StoredChecksum>& batches, CheckedRecords& records) {
  const std::string sql = "SELECT * FROM " + table + " ORDER BY seq";
  Statement row = database.prepare(sql.c_str());
  bool has_row = row.step();
  std::size_t n_uncovered = 0;
  std::int64_t last_seq = std::numeric_limits<std::int64_t>::min();
  const auto skip_to = [&](std::int64_t seq) {
    for (; has_row && row.integer(0) < seq; has_row = row.step()) ++n_uncovered;
  };
  for (const StoredChecksum& batch : batches) {
    if (batch.first_seq <= last_seq || batch.last_seq < batch.first_seq) {
      records.damaged_tables.push_back(table);
      records.check.faults.push_back("the table of checksums is damaged: records of " + table +
                                     " are in two of them, or in none");
      continue;
    }
    last_seq = batch.last_seq;
    skip_to(batch.first_seq);
    RowChecksum now;
    for (; has_row && row.integer(0) <= batch.last_seq; has_row = row.step()) now.add_row(row);
    add_batch(batch, now, records);
  }
  skip_to(std::numeric_limits<std::int64_t>::max());
  if (n_uncovered == 0) return;
  records.damaged_tables.push_back(table);
  records.check.faults.push_back("table " + table + " holds " + std::to_string(n_uncovered) +
                                 " rows without a checksum");
}

void check_all(Database& database, CheckedRecords& records) {
  std::map<std::string, std::vector<StoredChecksum>> batches;
  bool has_start = false, has_end = false;
  for (const StoredChecksum& stored : stored_checksums(database)) {
    has_start = has_start || stored.table == kRunStart;
    has_end = has_end || stored.table == kRunEnd;
    if (stored.table == kRunStart || stored.table == kRunEnd) {
      check_run(database, stored, records);
    } else if (is_record_table(stored.table)) {
      batches[stored.table].push_back(stored);
    } else {
      records.check.faults.push_back("the table of checksums is damaged: it names " + stored.table);
    }
  }
  const bool has_temperatures = schema_of(database) >= kFirstSchemaWithTemperatures;
  for (const char* table : kRecordTables) {
    if (!has_temperatures && std::string_view(table) == "temperatures") continue;
    check_table(database, table, batches[table], records);
  }
  const bool is_open = database.text_of("SELECT value FROM run WHERE key = 'status'") == "open";
  if (!has_start || has_end == is_open) {
    records.is_description_damaged = true;
    records.check.faults.push_back("the checksum of the start or of the end of the run is missing");
  }
}

}  // namespace

bool CheckedRecords::is_damaged(const std::string& table) const {
  return std::find(damaged_tables.begin(), damaged_tables.end(), table) != damaged_tables.end();
}

bool CheckedRecords::is_sound(const std::string& table, std::int64_t seq) const {
  if (!check.is_checked || !is_damaged(table)) return true;
  const auto ranges = sound.find(table);
  if (ranges == sound.end()) return false;
  const auto after = std::upper_bound(
      ranges->second.begin(), ranges->second.end(), seq,
      [](std::int64_t one, const RecordRange& range) { return one < range.first_seq; });
  return after != ranges->second.begin() && seq <= std::prev(after)->last_seq;
}

CheckedRecords check_records(Database& database) {
  CheckedRecords records;
  const bool has_table =
      !database.text_of("SELECT name FROM sqlite_schema WHERE name = 'checksums'").empty();
  const bool is_recent = schema_of(database) >= kFirstSchemaWithChecksums;
  records.check.is_checked = has_table || is_recent;
  if (has_table != is_recent) {
    records.is_description_damaged = true;
    records.check.faults.push_back("the number of its schema does not fit its tables");
  }
  if (has_table) check_all(database, records);
  return records;
}

CaptureCheck check_capture(const std::filesystem::path& path) {
  OpenCapture capture(path);
  Database& database = capture.database();
  CaptureCheck check;
  try {
    database.execute("BEGIN");
    if (database.text_of("PRAGMA integrity_check(1)") != "ok") {
      throw SqliteError(path.string(), SQLITE_CORRUPT);
    }
    check = check_records(database).check;
    database.execute("COMMIT");
    if (!capture.side_file().damage.empty()) check.faults.push_back(capture.side_file().damage);
    if (capture.side_file().is_torn) check.faults.emplace_back(kTornLogText);
  } catch (const SqliteError& error) {
    capture.explain(error);
  }
  // The checksums cover the records and not the names of tables and columns.
  try {
    const RecordIntegrity integrity = read_capture(path, {.accepts_damage = true}).integrity;
    if (integrity.has_lost_log) {
      check.faults.push_back("the run was interrupted, and its side file " + integrity.lost_log +
                             ", which may hold its last seconds, or all of it, is missing: copy it "
                             "with the capture");
    }
  } catch (const std::runtime_error& error) {
    check.faults.emplace_back(error.what());
  }
  return check;
}

}  // namespace viscard
