#pragma once

#include <filesystem>
#include <string>

namespace viscard {

// What lies in the write-ahead log beside a capture (*-wal). SQLite leaves out a frame that is not what
// was written, and all frames behind it, without a word, so the log is walked here before it is read.
struct SideFileCheck {
  // What is not what was written, although it was safe on the disk; "" if nothing is.
  std::string damage;
  // The end of the log, which no sync had made safe yet, has a hole, as a power cut leaves one.
  bool is_torn = false;
};

// Follows the checksums of the log from its header on:
// https://www.sqlite.org/fileformat2.html#walformat. Frames of an earlier use of the log, and a last
// frame that is not whole, are no damage. Precondition: nobody is writing the log.
SideFileCheck check_side_file(const std::filesystem::path& log);

}  // namespace viscard
