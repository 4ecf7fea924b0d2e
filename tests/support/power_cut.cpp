#include "tests/support/power_cut.h"

#include <dlfcn.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <mutex>
#include <sstream>
#include <stdexcept>

namespace viscard::test {
namespace {

namespace fs = std::filesystem;

std::mutex& disk_mutex() {
  static std::mutex the_mutex;
  return the_mutex;
}

LossyDisk*& watched_disk() {
  static LossyDisk* disk = nullptr;
  return disk;
}

fs::path path_of(int descriptor) {
  std::error_code ignored;
  return fs::read_symlink("/proc/self/fd/" + std::to_string(descriptor), ignored);
}

// Reads through the descriptor itself: closing a second one would drop the locks of SQLite.
std::string contents_of(int descriptor) {
  std::string contents;
  char buffer[1 << 16];
  ssize_t n = 0;
  while ((n = ::pread(descriptor, buffer, sizeof buffer, static_cast<off_t>(contents.size()))) >
         0) {
    contents.append(buffer, static_cast<std::size_t>(n));
  }
  if (n == 0) return contents;
  // Opened for writing only; nothing locks such a file.
  std::ifstream file("/proc/self/fd/" + std::to_string(descriptor), std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

int sync_and_watch(const char* function, int descriptor) {
  using Sync = int (*)(int);
  const auto real = reinterpret_cast<Sync>(::dlsym(RTLD_NEXT, function));
  const int status = real(descriptor);
  const std::lock_guard<std::mutex> lock(disk_mutex());
  if (status != 0 || watched_disk() == nullptr) return status;
  const int error = watched_disk()->synced(descriptor);
  if (error == 0) return 0;
  errno = error;
  return -1;
}

}  // namespace

LossyDisk::LossyDisk(const fs::path& folder) : folder_(fs::canonical(folder)), states_(1) {
  keep_entries();
  for (const auto& [name, id] : states_.back().entries) {
    std::ifstream file(folder_ / name, std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    states_.back().contents[id] = text.str();
  }
  const std::lock_guard<std::mutex> lock(disk_mutex());
  watched_disk() = this;
}

LossyDisk::~LossyDisk() {
  const std::lock_guard<std::mutex> lock(disk_mutex());
  watched_disk() = nullptr;
}

std::size_t LossyDisk::n_states() const {
  const std::lock_guard<std::mutex> lock(disk_mutex());
  return states_.size();
}

void LossyDisk::restore(std::size_t state, const fs::path& into) const {
  State kept;
  {
    const std::lock_guard<std::mutex> lock(disk_mutex());
    kept = states_.at(state);
  }
  for (const auto& [name, id] : kept.entries) {
    std::ofstream(into / name, std::ios::binary) << kept.contents[id];
  }
}

void LossyDisk::fail_folder_syncs(int error) {
  const std::lock_guard<std::mutex> lock(disk_mutex());
  folder_error_ = error;
}

int LossyDisk::synced(int descriptor) {
  struct stat about {};
  if (::fstat(descriptor, &about) != 0) return 0;
  const fs::path path = path_of(descriptor);
  if (S_ISDIR(about.st_mode) && path == folder_) {
    if (folder_error_ != 0) return folder_error_;
    states_.push_back(states_.back());
    keep_entries();
  } else if (S_ISREG(about.st_mode) && path.parent_path() == folder_) {
    states_.push_back(states_.back());
    states_.back().contents[id_of("", descriptor)] = contents_of(descriptor);
  }
  return 0;
}

void LossyDisk::keep_entries() {
  auto& entries = states_.back().entries;
  entries.clear();
  for (const auto& entry : fs::directory_iterator(folder_)) {
    if (!entry.is_regular_file()) continue;
    entries[entry.path().filename().string()] = id_of(entry.path().c_str(), AT_FDCWD);
  }
}

// Inode numbers are used again, so the time of birth is compared too.
LossyDisk::FileId LossyDisk::id_of(const char* path, int descriptor) {
  struct statx about {};
  if (::statx(descriptor, path, AT_EMPTY_PATH, STATX_INO | STATX_BTIME, &about) != 0) {
    throw std::runtime_error("statx fails");
  }
  return {about.stx_ino, about.stx_btime.tv_sec * 1'000'000'000LL + about.stx_btime.tv_nsec};
}

}  // namespace viscard::test

// These stand before those of the C library, also for SQLite.
extern "C" __attribute__((visibility("default"))) int fsync(int descriptor) {
  return viscard::test::sync_and_watch("fsync", descriptor);
}
extern "C" __attribute__((visibility("default"))) int fdatasync(int descriptor) {
  return viscard::test::sync_and_watch("fdatasync", descriptor);
}
