#include "io/basics/atomic_file.h"

#include "io/basics/inputs.h"
#include "io/basics/missing_file.h"
#include "io/basics/output_name.h"
#include "io/basics/written_path.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <map>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

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

namespace fs = std::filesystem;

constexpr std::string_view kTemporaryEnding = ".tmp";

// The longest name that a file may have, less the other parts of the name of a temporary one.
constexpr std::size_t kLongestName = 255;
std::string name_in_temporary(const fs::path& path) {
  constexpr std::size_t kOtherParts = 2 + 10;  // two dots and the number of a process
  return path.filename().string().substr(0, kLongestName - kOtherParts - kTemporaryEnding.size());
}

fs::path temporary_for(const fs::path& folder, const fs::path& path) {
  return folder / ("." + name_in_temporary(path) + "." + std::to_string(::getpid()) +
                   std::string(kTemporaryEnding));
}

// A temporary file and the process that wrote it.
struct Leftover {
  fs::path file;
  pid_t writer = 0;
};

// Reads ".NAME.PID.tmp"; returns NAME.
std::optional<std::string> target_of(const fs::path& file, pid_t& writer) {
  const std::string name = file.filename().string();
  if (name.size() < 8 || name.front() != '.' || !name.ends_with(kTemporaryEnding)) return {};
  const std::size_t end = name.size() - kTemporaryEnding.size();
  const std::size_t dot = name.rfind('.', end - 1);
  const std::string pid = name.substr(dot + 1, end - dot - 1);
  const bool is_number =
      !pid.empty() && pid.size() < 10 && pid.find_first_not_of("0123456789") == std::string::npos;
  if (dot == 0 || !is_number) return {};
  writer = static_cast<pid_t>(std::stol(pid));
  return name.substr(1, dot - 1);
}

using Leftovers = std::multimap<std::string, Leftover>;

Leftovers leftovers_in(const fs::path& folder) {
  Leftovers found;
  std::error_code ignored;
  for (fs::directory_iterator entry(folder, ignored), end; !ignored && entry != end;
       entry.increment(ignored)) {
    Leftover leftover{entry->path(), 0};
    const auto target = target_of(leftover.file, leftover.writer);
    if (target) found.emplace(*target, leftover);
  }
  return found;
}

// On a network share the writer may live on another machine; then it holds the lock.
bool is_abandoned(const Leftover& leftover) {
  if (leftover.writer == ::getpid() || ::kill(leftover.writer, 0) == 0 || errno != ESRCH) {
    return false;
  }
  const Descriptor file(::open(leftover.file.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW));
  return file.get() >= 0 && ::flock(file.get(), LOCK_EX | LOCK_NB) == 0;
}

// Removes what an earlier process, ended by a power cut or a kill, has left of this file. A folder
// is listed once per process, because a run may write thousands of files into it.
void remove_leftovers(const fs::path& folder, const fs::path& path) {
  static std::mutex mutex;
  static std::map<std::string, Leftovers> listed;
  const std::lock_guard<std::mutex> lock(mutex);
  std::error_code ignored;
  const std::string key = fs::absolute(folder, ignored).string();
  auto place = listed.find(key);
  if (place == listed.end()) place = listed.emplace(key, leftovers_in(folder)).first;
  const auto [begin, end] = place->second.equal_range(name_in_temporary(path));
  for (auto one = begin; one != end; ++one) {
    if (is_abandoned(one->second)) fs::remove(one->second.file, ignored);
  }
  place->second.erase(begin, end);
}

// Creates a new file: never writes into one that lies there already, nor through a link that somebody
// has put in its place.
int create_temporary(const fs::path& temporary, const fs::path& path,
                     std::optional<unsigned> mode) {
  const auto create = [&] {
    return ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC,
                  mode.value_or(0666));
  };
  int fd = create();
  if (fd < 0 && errno == EEXIST) {
    // A process with the same number may have left it, on an earlier day or in another container.
    const Descriptor old(::open(temporary.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK));
    if (old.get() >= 0 && ::flock(old.get(), LOCK_EX | LOCK_NB) != 0) {
      throw std::runtime_error(path.string() +
                               " is being written by another thread or process; wait for it, or "
                               "choose another name");
    }
    ::unlink(temporary.c_str());
    fd = create();
  }
  if (fd < 0) fail(path, "cannot create", errno);
  return fd;
}

// Gives the complete temporary file its name.
void put_in_place(const fs::path& temporary, const fs::path& path, bool overwrite) {
  if (overwrite) {
    if (::rename(temporary.c_str(), path.c_str()) != 0) fail(path, "cannot rename", errno);
    return;
  }
  // link() refuses an existing name, so a file that another process creates meanwhile is kept.
  if (::link(temporary.c_str(), path.c_str()) == 0) {
    ::unlink(temporary.c_str());
  } else if (errno != EPERM && errno != EOPNOTSUPP) {
    fail(path, "cannot create", errno);
  } else if (::rename(temporary.c_str(), path.c_str()) != 0) {  // FAT has no hard links
    fail(path, "cannot rename", errno);
  }
}

}  // namespace

std::optional<unsigned> rights_of_file(const std::filesystem::path& path) {
  struct stat old {};
  if (::stat(path.c_str(), &old) != 0) return {};
  return old.st_mode & 0777;
}

void sync_folder(const std::filesystem::path& folder) {
  const std::string what =
      "cannot sync this folder, so a power cut may lose what was written in it";
  const Descriptor directory(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (directory.get() < 0) fail(folder, what, errno);
  if (::fsync(directory.get()) != 0 && errno != EINVAL && errno != ENOTSUP) {
    fail(folder, what, errno);
  }
}

namespace {

void put_file(const std::filesystem::path& path, const std::string& contents, bool overwrite) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) fail(path, "cannot write", EISDIR);
  if (std::filesystem::exists(path, ignored) && !std::filesystem::is_regular_file(path, ignored)) {
    throw std::runtime_error(
        path.string() + " is a device or pipe, which the file would replace; choose another name");
  }
  remember_folder_of(path);
  refuse_output_name(path);
  if (!overwrite && std::filesystem::exists(path, ignored)) {
    throw std::runtime_error(path.string() +
                             " exists already; pass --force to replace it, or choose another name");
  }
  const std::filesystem::path folder =
      path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
  remove_leftovers(folder, path);
  const std::filesystem::path temporary = temporary_for(folder, path);
  const std::optional<unsigned> old_mode = rights_of_file(path);
  Descriptor file(create_temporary(temporary, path, old_mode));
  ::flock(file.get(), LOCK_EX | LOCK_NB);  // marks a live writer; without locks the pid decides
  try {
    // The umask may have taken rights away that the old file had.
    if (old_mode && ::fchmod(file.get(), *old_mode) != 0)
      fail(path, "cannot keep the rights", errno);
    write_all(file.get(), contents, path);
    if (::fsync(file.get()) != 0) fail(path, "cannot sync", errno);
    if (::close(file.release()) != 0) fail(path, "cannot close", errno);
    note_output(path);
    put_in_place(temporary, path, overwrite);
    sync_folder(folder);
  } catch (...) {
    ::unlink(temporary.c_str());
    throw;
  }
}

// A program that writes into a named pipe is there at once, or the pipe was left over.
void await_writer(const std::filesystem::path& path, int fd) {
  constexpr int kWait_ms = 5000;
  pollfd pipe{fd, POLLIN, 0};
  if (::poll(&pipe, 1, kWait_ms) != 0) return;
  throw std::runtime_error(
      path.string() +
      ": cannot read: it is a pipe into which no program writes; name a file, or "
      "start the program that writes first");
}

int open_to_read(const std::filesystem::path& path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) {
    throw std::runtime_error(path.string() + ": cannot read: Is a directory; name a file in it");
  }
  // A named pipe without a writer would not even open otherwise.
  Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOCTTY | O_NONBLOCK));
  if (file.get() < 0) {
    throw std::runtime_error(path.string() + ": " + why_not_opened(path, errno));
  }
  if (std::filesystem::is_fifo(path, ignored)) await_writer(path, file.get());
  ::fcntl(file.get(), F_SETFL, ::fcntl(file.get(), F_GETFL) & ~O_NONBLOCK);
  return file.release();
}

// 0 at the end.
std::size_t read_some(const std::filesystem::path& path, int fd, char* bytes, std::size_t n_bytes) {
  while (true) {
    const ssize_t count = ::read(fd, bytes, n_bytes);
    if (count >= 0) return static_cast<std::size_t>(count);
    if (errno != EINTR) fail(path, "cannot read", errno);
  }
}

[[noreturn]] void refuse_size(const std::filesystem::path& path, std::size_t most) {
  std::error_code ignored;
  const bool has_end = std::filesystem::is_regular_file(path, ignored);
  throw std::runtime_error(path.string() + (has_end ? ": has more than " : ": did not end after ") +
                           std::to_string(most >> 20) +
                           " MiB, the limit of such a file; save a part of it to another file");
}

}  // namespace

void write_file(const std::filesystem::path& path, const std::string& contents, bool overwrite) {
  if (overwrite) refuse_input(path);
  put_file(path, contents, overwrite);
}

void refuse_input(const std::filesystem::path& path) {
  if (!is_input(path)) return;
  throw std::runtime_error(path.string() +
                           " is read by this command, so it is not replaced; choose another name");
}

void rewrite_file(const std::filesystem::path& path, const std::string& contents) {
  put_file(path, contents, true);
}

std::string read_file(const std::filesystem::path& path, std::size_t most) {
  try {
    std::string contents = read_own_file(path, most);
    record_input(path, contents);
    return contents;
  } catch (const StopsWork&) {
    throw;
  } catch (const std::runtime_error& error) {
    refuse_lost_input(path, error.what());
    throw;
  }
}

std::string read_own_file(const std::filesystem::path& path, std::size_t most) {
  const Descriptor file(open_to_read(path));
  std::error_code ignored;
  if (std::filesystem::is_character_file(path, ignored)) most = std::min(most, kLongestText);
  const auto expected = std::filesystem::file_size(path, ignored);  // fails for a pipe
  if (!ignored && expected > most) refuse_size(path, most);
  std::string contents;
  contents.resize(
      ignored ? 0 : static_cast<std::size_t>(expected) + 1);  // one more byte, to detect the end
  std::size_t size = 0;
  while (true) {
    if (size > most) refuse_size(path, most);  // devices and pipes may never end
    if (size == contents.size()) contents.resize(size + std::max<std::size_t>(size, 1 << 16));
    const std::size_t count =
        read_some(path, file.get(), contents.data() + size, contents.size() - size);
    if (count == 0) break;
    size += count;
  }
  contents.resize(size);
  return contents;
}

std::string sha256_of_file(const std::filesystem::path& path) {
  const Descriptor file(open_to_read(path));
  Sha256 sum;
  std::vector<char> piece(std::size_t{1} << 20);
  std::error_code ignored;
  const bool has_end = std::filesystem::is_regular_file(path, ignored);
  std::size_t n_read = 0;
  while (const std::size_t count = read_some(path, file.get(), piece.data(), piece.size())) {
    sum.add(piece.data(), count);
    n_read += count;
    if (!has_end && n_read > kLongestText) refuse_size(path, kLongestText);
  }
  const std::string digits = sum.digits();
  record_input_sum(path, digits);
  return digits;
}

std::string sha256_as_read(const std::filesystem::path& path) {
  const std::optional<std::string> recorded = recorded_sum(path);
  return recorded ? *recorded : sha256_of_file(path);
}

void record_input_file(const std::filesystem::path& path) {
  if (is_recording_inputs()) sha256_of_file(path);
}

}  // namespace viscard
