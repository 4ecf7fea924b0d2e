#include "io/capture/row_checksum.h"

#include <array>

namespace viscard {
namespace {

constexpr std::array<std::uint32_t, 256> crc_table() {
  std::array<std::uint32_t, 256> table{};
  for (std::uint32_t i = 0; i < 256; ++i) {
    std::uint32_t value = i;
    for (int bit = 0; bit < 8; ++bit) value = value >> 1 ^ ((value & 1) != 0 ? 0xedb88320 : 0);
    table[i] = value;
  }
  return table;
}

}  // namespace

void RowChecksum::add(std::string_view bytes) {
  static constexpr std::array<std::uint32_t, 256> kTable = crc_table();
  for (const char c : bytes) {
    state_ = state_ >> 8 ^ kTable[(state_ ^ static_cast<unsigned char>(c)) & 0xff];
  }
}

void RowChecksum::add_row(const Statement& row) {
  add(row.canonical_row());
  ++n_rows_;
}

RowChecksum checksum_of_rows(Database& database, const std::string& table, std::int64_t first_seq,
                             std::int64_t last_seq) {
  const std::string sql = "SELECT * FROM " + table + " WHERE seq BETWEEN ? AND ? ORDER BY seq";
  Statement row = database.prepare(sql.c_str());
  row.bind(1, first_seq);
  row.bind(2, last_seq);
  RowChecksum checksum;
  while (row.step()) checksum.add_row(row);
  return checksum;
}

RowChecksum checksum_of_run(Database& database, RunPart part) {
  Statement row = database.prepare(
      part == RunPart::kStart
          ? "SELECT key, value FROM run WHERE key IN ('program', 'command', 'started_at', "
            "'start_clock_monotonic_s', 'start_clock_realtime_s', 'boot_id', 'rig_toml', "
            "'test_toml', 'specimen_toml') ORDER BY key"
          : "SELECT key, value FROM run WHERE key IN ('status', 'finished_at', "
            "'finish_clock_monotonic_s', 'finish_clock_realtime_s') ORDER BY key");
  RowChecksum checksum;
  while (row.step()) checksum.add_row(row);
  return checksum;
}

}  // namespace viscard
