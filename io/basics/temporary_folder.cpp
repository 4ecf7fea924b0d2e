#include "io/basics/temporary_folder.h"

#include <fcntl.h>
#include <stdlib.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <string>
#include <system_error>

namespace viscard {
namespace {

namespace fs = std::filesystem;

constexpr const char* kBegin = "viscard-folder-";

// Opens the folder and locks it. Below 0, with errno, if another process has it or it is none.
int lock_of_folder(const fs::path& folder) {
  const int lock = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  if (lock < 0 || ::flock(lock, LOCK_EX | LOCK_NB) == 0) return lock;
  const int error = errno;
  ::close(lock);
  errno = error;
  return -1;
}

// A process id says nothing in a container, whose /tmp may be that of the host. A lock does.
void remove_abandoned(const fs::path& parent) {
  std::error_code error;
  for (fs::directory_iterator entry(parent, error), end; !error && entry != end;
       entry.increment(error)) {
    struct stat found {};
    if (!entry->path().filename().string().starts_with(kBegin) ||
        ::lstat(entry->path().c_str(), &found) != 0 || found.st_uid != ::geteuid()) {
      continue;
    }
    const int lock = lock_of_folder(entry->path());
    if (lock < 0) continue;
    std::error_code ignored;
    fs::remove_all(entry->path(), ignored);
    ::close(lock);
  }
}

}  // namespace

TemporaryFolder::TemporaryFolder() {
  std::error_code error;
  const fs::path parent = fs::temp_directory_path(error);
  const auto fail = [&](const std::string& reason) {
    throw std::runtime_error("cannot make a folder for temporary files" +
                             (parent.empty() ? "" : " in " + parent.string()) + ": " + reason +
                             "; set TMPDIR to a folder that can be written");
  };
  if (error) fail(error.message());
  remove_abandoned(parent);
  const std::string pattern = (parent / (kBegin + std::to_string(::getpid()) + "-XXXXXX")).string();
  // Another process may take a new folder for an abandoned one before it is locked.
  constexpr int kMostTries = 100;
  for (int i = 0; i < kMostTries; ++i) {
    std::string name = pattern;
    if (::mkdtemp(name.data()) == nullptr) fail(std::strerror(errno));
    lock_ = lock_of_folder(name);
    const bool has_no_locks = lock_ < 0 && errno != EWOULDBLOCK && errno != ENOENT;
    if (lock_ < 0 && !has_no_locks) continue;
    if (fs::exists(name)) {
      path_ = name;
      return;
    }
    ::close(lock_);
    lock_ = -1;
  }
  fail("other programs remove it");
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
  if (lock_ >= 0) ::close(lock_);
}

}  // namespace viscard
