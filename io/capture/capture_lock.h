#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace viscard {

// Marks a capture as being written by a live process: by an flock on the file (independent of
// SQLite's own locks, and released when the process ends) and by a list within this process. The
// list is needed because opening and closing the file here would drop the fcntl locks of SQLite's
// own connection.
class CaptureLock {
 public:
  // Creates the file. With overwrite an old one and its side files are removed first; the new one has
  // its rights, or `rights` if they are given (atomic_file.h). Throws
  // std::runtime_error if the file exists and overwrite is false, if the folder does not exist, if
  // it is not a plain file, if it is being written, if a capture that was moved away has left its log here, or if
  // no output may have the name (io/basics/output_name.h).
  CaptureLock(const std::filesystem::path& path, bool overwrite,
              std::optional<unsigned> rights = {});
  ~CaptureLock();
  CaptureLock(const CaptureLock&) = delete;
  CaptureLock& operator=(const CaptureLock&) = delete;

  // Precondition: SQLite's connection is closed.
  void release();

  // Why nothing more can be read from the file under its name: it was deleted, moved (to where) or
  // replaced. Empty: it is where it was created.
  std::string why_gone() const;

 private:
  std::filesystem::path path_;
  std::string key_;
  int fd_ = -1;
};

// True while a live process, this one or another, is writing the capture.
bool is_being_captured(const std::filesystem::path& path);

// The capture that a new one replaces. It stays beside the new one until drop() is called, and is
// restored by the destructor if that never happens: a cable that is not plugged in, or a punch that
// presses already, must not destroy yesterday's record.
class PreviousCapture {
 public:
  // Puts the file aside if there is one to replace, in one file: what an interrupted run has left in its log is
  // merged into it, unless the log is damaged. Throws std::runtime_error if an earlier capture, or part of it, is
  // still aside, or if the log beside the file is of another run.
  PreviousCapture(std::filesystem::path path, bool is_replaced);
  ~PreviousCapture();
  PreviousCapture(const PreviousCapture&) = delete;
  PreviousCapture& operator=(const PreviousCapture&) = delete;

  bool is_aside() const { return is_aside_; }
  // Those of the old capture, which the new one shall have.
  std::optional<unsigned> rights() const { return rights_; }
  // Removes the old capture for good.
  void drop();

 private:
  std::filesystem::path part(const char* suffix) const;
  std::filesystem::path aside(const char* suffix) const;
  void refuse_kept() const;

  std::filesystem::path path_;
  bool is_aside_ = false;
  std::optional<unsigned> rights_;
};

}  // namespace viscard
