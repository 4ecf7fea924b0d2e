#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace viscard {

// Whether a capture still holds what was written. Every transaction stores a CRC-32 of its rows in
// each table, so that a bit that the disk or a copy has flipped is noticed.
struct CaptureCheck {
  bool is_checked = false;  // false: written before captures carried checksums
  std::size_t n_batches = 0;
  std::size_t n_records = 0;
  std::vector<std::string> faults;  // one line each: what and where
};

// Never changes the file. Throws as read_capture() does, also if the damage prevents reading.
CaptureCheck check_capture(const std::filesystem::path& path);

}  // namespace viscard
