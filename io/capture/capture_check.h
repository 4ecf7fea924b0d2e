#pragma once

#include <cstddef>
#include <filesystem>
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

// Never changes the file. Throws as read_capture() does, also if the damage prevents reading.
CaptureCheck check_capture(const std::filesystem::path& path);

}  // namespace viscard
