#pragma once

#include <filesystem>
#include <string>

namespace viscard {

// Marks a capture as being written by a live process: by an flock on the file (independent of
// SQLite's own locks, and released when the process ends) and by a list within this process. The
// list is needed because opening and closing the file here would drop the fcntl locks of SQLite's
// own connection.
class CaptureLock {
 public:
  // Creates the file. With overwrite an old one and its side files are removed first. Throws
  // std::runtime_error if the file exists and overwrite is false, if the folder does not exist, if
  // it is not a plain file, or if it is being written.
  CaptureLock(const std::filesystem::path& path, bool overwrite);
  ~CaptureLock();
  CaptureLock(const CaptureLock&) = delete;
  CaptureLock& operator=(const CaptureLock&) = delete;

  // Precondition: SQLite's connection is closed.
  void release();

 private:
  std::string key_;
  int fd_ = -1;
};

// True while a live process, this one or another, is writing the capture.
bool is_being_captured(const std::filesystem::path& path);

}  // namespace viscard
