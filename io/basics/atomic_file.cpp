#include "io/basics/atomic_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace viscard {
namespace {

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& what, int error) {
  throw std::runtime_error(path.string() + ": " + what + ": " + std::strerror(error));
}

class Descriptor {
 public:
  explicit Descriptor(int fd) : fd_(fd) {}
  ~Descriptor() {
    if (fd_ >= 0) ::close(fd_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int get() const { return fd_; }
  int release() { return std::exchange(fd_, -1); }

 private:
  int fd_;
};

void write_all(int fd, const std::string& contents, const std::filesystem::path& path) {
  std::size_t done = 0;
  while (done < contents.size()) {
    const ssize_t count = ::write(fd, contents.data() + done, contents.size() - done);
    if (count < 0) {
      if (errno == EINTR) continue;
      fail(path, "cannot write", errno);
    }
    done += static_cast<std::size_t>(count);
  }
}

}  // namespace

void sync_folder(const std::filesystem::path& folder) {
  const Descriptor directory(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (directory.get() >= 0) ::fsync(directory.get());
}

void write_file(const std::filesystem::path& path, const std::string& contents, bool overwrite) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) fail(path, "cannot write", EISDIR);
  if (std::filesystem::exists(path, ignored) && !std::filesystem::is_regular_file(path, ignored)) {
    throw std::runtime_error(
        path.string() + " is a device or pipe, which the file would replace; choose another name");
  }
  if (!overwrite && std::filesystem::exists(path, ignored)) {
    throw std::runtime_error(path.string() +
                             " exists already; pass --force to replace it, or choose another name");
  }
  const std::filesystem::path folder =
      path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
  const std::filesystem::path temporary =
      folder / ("." + path.filename().string() + "." + std::to_string(::getpid()) + ".tmp");
  Descriptor file(::open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666));
  if (file.get() < 0) fail(path, "cannot create", errno);
  try {
    write_all(file.get(), contents, path);
    if (::fsync(file.get()) != 0) fail(path, "cannot sync", errno);
    if (::close(file.release()) != 0) fail(path, "cannot close", errno);
    if (overwrite) {
      if (::rename(temporary.c_str(), path.c_str()) != 0) fail(path, "cannot rename", errno);
    } else {
      // link() refuses an existing name, so a file that another process creates meanwhile is kept.
      if (::link(temporary.c_str(), path.c_str()) == 0) {
        ::unlink(temporary.c_str());
      } else if (errno != EPERM && errno != EOPNOTSUPP) {
        fail(path, "cannot create", errno);
      } else if (::rename(temporary.c_str(), path.c_str()) != 0) {  // FAT has no hard links
        fail(path, "cannot rename", errno);
      }
    }
    sync_folder(folder);
  } catch (...) {
    ::unlink(temporary.c_str());
    throw;
  }
}

std::string read_file(const std::filesystem::path& path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) fail(path, "cannot read", EISDIR);
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOCTTY));
  if (file.get() < 0) fail(path, "cannot open", errno);
  std::string contents;
  std::size_t size = 0;
  const auto expected = std::filesystem::file_size(path, ignored);  // fails for a pipe
  contents.resize(
      ignored ? 0 : static_cast<std::size_t>(expected) + 1);  // one more byte, to detect the end
  while (true) {
    if (size == contents.size()) contents.resize(size + std::max<std::size_t>(size, 1 << 16));
    const ssize_t count = ::read(file.get(), contents.data() + size, contents.size() - size);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) fail(path, "cannot read", errno);
    if (count == 0) break;
    size += static_cast<std::size_t>(count);
  }
  contents.resize(size);
  return contents;
}

}  // namespace viscard
