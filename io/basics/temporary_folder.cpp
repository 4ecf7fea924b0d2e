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

// Below 0, with errno, if it is none.
int opened_folder(const fs::path& folder) {
  return ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
}

bool locks(int folder) {
  return ::flock(folder, LOCK_EX | LOCK_NB) == 0;
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
    const int folder = opened_folder(entry->path());
    if (folder < 0) continue;
    std::error_code ignored;
    if (locks(folder)) fs::remove_all(entry->path(), ignored);
    ::close(folder);
  }
}

}  // namespace

TemporaryFolder::TemporaryFolder() {
  std::error_code error;
  const fs::path parent = fs::temp_directory_path(error);
  const auto fail = [&](const std::string& reason) {
    throw std::runtime_error("cannot make a folder for temporary files" +
                             (parent.empty() ? "" : " in " + parent.string()) + ": " + reason);
  };
  const std::string other_place = "; set TMPDIR to a folder that can be written";
  if (error) fail(error.message() + other_place);
  remove_abandoned(parent);
  const std::string pattern = (parent / (kBegin + std::to_string(::getpid()) + "-XXXXXX")).string();
  // Another process may take a new folder for an abandoned one before it is locked.
  constexpr int kMostTries = 100;
  for (int i = 0; i < kMostTries; ++i) {
    std::string name = pattern;
    if (::mkdtemp(name.data()) == nullptr) fail(std::strerror(errno) + other_place);
    lock_ = opened_folder(name);
    if (lock_ < 0) {
      if (errno == ENOENT) continue;
      const int cause = errno;
      ::rmdir(name.c_str());  // without a lock another process would remove it while it is used
      if (cause == EMFILE || cause == ENFILE)
        fail("too many files are open; raise the limit (ulimit -n)");
      fail(std::strerror(cause) + other_place);
    }
    // In a file system without locks no process removes folders.
    if ((locks(lock_) || errno != EWOULDBLOCK) && fs::exists(name)) {
      path_ = name;
      return;
    }
    ::close(lock_);
    lock_ = -1;
  }
  fail("other programs remove it" + other_place);
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
  if (lock_ >= 0) ::close(lock_);
}

}  // namespace viscard
