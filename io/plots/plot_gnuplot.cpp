#include "io/plots/plot_script.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <string_view>
#include <vector>

namespace viscard {
namespace {

[[noreturn]] void fail(const char* what, int error) {
  throw std::runtime_error(std::string("plots: ") + what + ": " + std::strerror(error));
}

// A file without a name. Unlike pipes, three of them cannot block each other or raise SIGPIPE.
class MemoryFile {
 public:
  explicit MemoryFile(const char* name) : fd_(::memfd_create(name, MFD_CLOEXEC)) {
    if (fd_ < 0) fail("cannot make a file in memory for gnuplot", errno);
  }
  ~MemoryFile() { ::close(fd_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  int fd() const { return fd_; }

  void fill(const std::string& text) {
    std::size_t done = 0;
    while (done < text.size()) {
      const ssize_t count = ::write(fd_, text.data() + done, text.size() - done);
      if (count < 0 && errno == EINTR) continue;
      if (count < 0) fail("cannot hand the script to gnuplot", errno);
      done += static_cast<std::size_t>(count);
    }
    if (::lseek(fd_, 0, SEEK_SET) < 0) fail("cannot hand the script to gnuplot", errno);
  }

  std::string contents() const {
    std::string text;
    char buffer[65536];
    for (off_t offset = 0;;) {
      const ssize_t count = ::pread(fd_, buffer, sizeof buffer, offset);
      if (count < 0 && errno == EINTR) continue;
      if (count < 0) fail("cannot read what gnuplot drew", errno);
      if (count == 0) return text;
      text.append(buffer, static_cast<std::size_t>(count));
      offset += count;
    }
  }

 private:
  int fd_;
};

// The environment of this process with one fixed locale: UTF-8 text, a point in numbers.
std::vector<std::string> plain_environment() {
  std::vector<std::string> variables;
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string_view text(*entry);
    if (text.starts_with("LC_") || text.starts_with("LANG")) continue;
    variables.emplace_back(text);
  }
  variables.emplace_back("LC_ALL=C.UTF-8");
  return variables;
}

pid_t start_gnuplot(const MemoryFile& in, const MemoryFile& out, const MemoryFile& err) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, in.fd(), STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, out.fd(), STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, err.fd(), STDERR_FILENO);
  std::vector<std::string> variables = plain_environment();
  std::vector<char*> environment;
  for (std::string& variable : variables) environment.push_back(variable.data());
  environment.push_back(nullptr);
  std::string program = "gnuplot";
  std::string no_user_settings = "-d";
  char* arguments[] = {program.data(), no_user_settings.data(), nullptr};
  pid_t pid = -1;
  const int error =
      ::posix_spawnp(&pid, "gnuplot", &actions, nullptr, arguments, environment.data());
  posix_spawn_file_actions_destroy(&actions);
  if (error == ENOENT) {
    throw std::runtime_error(
        "plots need gnuplot, which is not installed; install it with: apt-get install gnuplot-nox");
  }
  if (error != 0) fail("gnuplot cannot be started", error);
  return pid;
}

int wait_for(pid_t pid) {
  int status = 0;
  while (::waitpid(pid, &status, 0) < 0) {
    if (errno != EINTR) fail("gnuplot was lost", errno);
  }
  return status;
}

// gnuplot prints the line of the script, a caret and then the reason: the last line is returned.
std::string message_of(const std::string& text) {
  std::size_t end = text.find_last_not_of(" \n\t");
  if (end == std::string::npos) return "it gave no reason";
  const std::size_t newline = text.rfind('\n', end);
  const std::size_t begin = newline == std::string::npos ? 0 : newline + 1;
  const std::string line = text.substr(begin, end - begin + 1);
  return line.substr(std::min(line.find_first_not_of(' '), line.size()));
}

}  // namespace

std::string run_gnuplot(const std::string& script) {
  MemoryFile in("gnuplot-script");
  const MemoryFile out("gnuplot-output");
  const MemoryFile err("gnuplot-messages");
  in.fill(script);
  const int status = wait_for(start_gnuplot(in, out, err));
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
    throw std::runtime_error("gnuplot could not draw a plot: " + message_of(err.contents()));
  }
  std::string drawn = out.contents();
  rlimit limit{};
  // gnuplot does not notice that it may write no more.
  if (::getrlimit(RLIMIT_FSIZE, &limit) == 0 && drawn.size() >= limit.rlim_cur) {
    throw std::runtime_error(
        "plots: the limit on the size of files (ulimit -f) cuts off what gnuplot draws; raise it");
  }
  return drawn;
}

}  // namespace viscard
