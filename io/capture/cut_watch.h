#pragma once

#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <string>

namespace viscard {

// Notices that the files of a capture lose what was written to them. During a run both only grow: rows
// are never deleted, and SQLite begins the log anew without cutting it (no journal_size_limit is set),
// until CaptureDatabase::finish() or the close of the file.
class CutWatch {
 public:
  explicit CutWatch(const std::filesystem::path& capture);

  enum class Loss { kNone, kCut, kLogGone };
  struct Finding {
    Loss loss = Loss::kNone;
    std::string text;  // "run.viscap was cut from 8192 to 0 bytes"
  };
  // Compares both files with the last look. A log that was never there is not missed, and whether the
  // main file is still under its name is asked elsewhere (CaptureLock::why_gone).
  Finding look();

 private:
  struct Seen {
    std::filesystem::path path;
    std::uintmax_t size_B = 0;
    ino_t inode = 0;  // 0: never seen
  };
  Seen file_, log_;
};

}  // namespace viscard
