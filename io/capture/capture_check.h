#pragma once

#include "io/capture/sqlite_database.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace viscard {

// Checks that a capture still holds the data that were written. Every transaction stores a CRC-32
// of its rows in each table, so a bit flipped by the disk or a copy is noticed.
struct CaptureCheck {
  bool is_checked = false;  // false: written before captures carried checksums
  std::size_t n_batches = 0;
  std::size_t n_records = 0;
  std::vector<std::string> faults;  // one line each: what and where
};

// Records of one table, by their numbers.
struct RecordRange {
  std::int64_t first_seq = 0, last_seq = 0;
};

// The same with what a reader needs in order to leave damaged rows out.
struct CheckedRecords {
  CaptureCheck check;
  bool is_description_damaged = false;  // also the end of the run, and the schema
  std::vector<std::string> damaged_tables;
  std::map<std::string, std::vector<RecordRange>> sound;  // by table, rising

  bool is_damaged(const std::string& table) const;
  // False for a record that is not what was written.
  bool is_sound(const std::string& table, std::int64_t seq) const;
};
// In the caller's transaction. Throws SqliteError.
CheckedRecords check_records(Database& database);

// Never changes the file. Throws as read_capture() does, also if the damage prevents reading.
CaptureCheck check_capture(const std::filesystem::path& path);

}  // namespace viscard
