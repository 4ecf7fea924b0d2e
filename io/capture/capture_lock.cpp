#include "io/capture/capture_lock.h"

#include "io/basics/atomic_file.h"
#include "io/basics/missing_file.h"
#include "io/basics/output_name.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <mutex>
#include <set>
#include <stdexcept>

namespace viscard {
namespace {

std::mutex& list_mutex() {
  static std::mutex the_mutex;
  return the_mutex;
}

std::set<std::string>& written_here() {
  static std::set<std::string> keys;
  return keys;
}

std::string key_of(const std::filesystem::path& path) {
  std::error_code ignored;
  const auto canonical = std::filesystem::weakly_canonical(path, ignored);
  return canonical.empty() ? path.string() : canonical.string();
}

bool is_written_here(const std::string& key) {
  const std::lock_guard<std::mutex> lock(list_mutex());
  return written_here().count(key) > 0;
}

// True if another process holds the flock.
bool is_written_elsewhere(const std::filesystem::path& path) {
  const int fd = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY);
  if (fd < 0) return false;
  const bool is_held = ::flock(fd, LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  ::close(fd);
  return is_held;
}

void remove_old(const std::filesystem::path& path, bool overwrite) {
  const std::string name = path.string();
  if (std::filesystem::exists(path)) {
    if (!std::filesystem::is_regular_file(path)) {
      throw std::runtime_error(name + " is not a plain file; choose another name for the capture");
    }
    if (!overwrite) {
      throw std::runtime_error(
          name + " exists already; pass --force to replace it, or choose another name");
    }
  }
  refuse_orphaned_log(path, "capture");
  for (const char* suffix : kDatabaseParts) std::filesystem::remove(name + suffix);
}

// SQLite gives the log the rights of the file, and must be able to write both.
void set_rights(int fd, const std::filesystem::path& path, unsigned rights) {
  if (::fchmod(fd, rights | S_IRUSR | S_IWUSR) == 0) return;
  throw std::runtime_error(path.string() +
                           ": cannot keep the rights of the capture that it replaces: " +
                           std::strerror(errno) + "; choose another name, or another disk");
}

}  // namespace

CaptureLock::CaptureLock(const std::filesystem::path& path, bool overwrite,
                         std::optional<unsigned> rights)
    : path_(path), key_(key_of(path)) {
  const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
  if (!std::filesystem::is_directory(folder)) {
    throw std::runtime_error(path.string() + ": there is no folder " + folder.string() +
                             "; create it first");
  }
  if (is_being_captured(path)) {
    throw std::runtime_error(path.string() +
                             " is being written by another capture; choose another name");
  }
  refuse_output_name(path);
  if (overwrite && !rights) rights = rights_of_file(path);
  remove_old(path, overwrite);
  fd_ = ::open(path.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (fd_ < 0) {
    throw std::runtime_error(path.string() + ": cannot create: " + std::strerror(errno));
  }
  if (::flock(fd_, LOCK_EX | LOCK_NB) != 0) {
    const int error = errno;
    ::close(fd_);
    throw std::runtime_error(path.string() + ": cannot lock: " + std::strerror(error));
  }
  try {
    if (rights) set_rights(fd_, path, *rights);
    sync_folder(folder);
  } catch (...) {
    ::close(fd_);
    std::filesystem::remove(path);
    throw;
  }
  const std::lock_guard<std::mutex> lock(list_mutex());
  written_here().insert(key_);
}

CaptureLock::~CaptureLock() {
  release();
}

void CaptureLock::release() {
  if (fd_ < 0) return;
  ::close(fd_);
  fd_ = -1;
  const std::lock_guard<std::mutex> lock(list_mutex());
  written_here().erase(key_);
}

std::string CaptureLock::why_gone() const {
  return fd_ < 0 ? std::string() : why_file_is_gone(fd_, path_);
}

bool is_being_captured(const std::filesystem::path& path) {
  return is_written_here(key_of(path)) || is_written_elsewhere(path);
}

}  // namespace viscard
