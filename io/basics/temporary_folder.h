#pragma once

#include <filesystem>

namespace viscard {

// A folder in that of the system for temporary files (TMPDIR), which the destructor removes with its files. The next one
// that is made removes those whose processes were killed. Throws std::runtime_error that names where it was tried.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path operator/(const std::filesystem::path& name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
  int lock_ = -1;  // of the folder; the system gives it up when the process ends
};

}  // namespace viscard
