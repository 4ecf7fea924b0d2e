#pragma once

#include <filesystem>
#include <string>

namespace viscard {

// Says that a live process is writing a capture: an flock on the file (independent of SQLite's own
// locks, gone with the process) and a list within this process, because opening and closing the
// file here would drop the fcntl locks that SQLite holds for its own connection.
class CaptureLock {
 public:
  // Creates the file, which must not exist unless overwrite is set; then the old one and its side
  // files are removed. Throws std::runtime_error: exists, no folder, not a plain file, being
  // written.
  CaptureLock(const std::filesystem::path& path, bool overwrite);
  ~CaptureLock();
  CaptureLock(const CaptureLock&) = delete;
  CaptureLock& operator=(const CaptureLock&) = delete;

  // Close SQLite's connection before this.
  void release();

 private:
  std::string key_;
  int fd_ = -1;
};

// True while a live process, this one or another, is writing the capture.
bool is_being_captured(const std::filesystem::path& path);

}  // namespace viscard
