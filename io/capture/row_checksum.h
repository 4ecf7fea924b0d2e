#pragma once

#include "io/capture/sqlite_database.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace viscard {

// CRC-32 (ISO 3309, as in zlib and PNG) of rows of a table. It changes with every flipped bit, and
// with every damage that is shorter than 33 bits.
class RowChecksum {
 public:
  void add(std::string_view bytes);
  // Adds type and value of each column of the statement's row.
  void add_row(const Statement& row);
  std::uint32_t crc32() const { return ~state_; }
  std::size_t n_rows() const { return n_rows_; }

 private:
  std::uint32_t state_ = 0xffffffff;
  std::size_t n_rows_ = 0;
};

// Of the rows with first_seq <= seq <= last_seq of one table, in their order. Throws SqliteError.
RowChecksum checksum_of_rows(Database& database, const std::string& table, std::int64_t first_seq,
                             std::int64_t last_seq);

// Of the entries of the table `run` that describe the run: those known at its start, or those of its
// end. Throws SqliteError.
enum class RunPart { kStart, kEnd };
RowChecksum checksum_of_run(Database& database, RunPart part);

// Names in the table `checksums` of parts that are not tables of records.
inline constexpr const char* kRunStart = "run at its start";
inline constexpr const char* kRunEnd = "run at its end";
// The tables of records.
inline constexpr const char* kRecordTables[] = {"raw_bytes", "load_samples", "stage_reports",
                                                "moves",     "events",       "temperatures"};

}  // namespace viscard
