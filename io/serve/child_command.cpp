#include "io/serve/child_command.h"

#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <optional>
#include <stdexcept>
#include <thread>

namespace viscard {
namespace {

using ChildClock = std::chrono::steady_clock;

// What a child reads and prints lies in memory, and no pipe can fill up.
class TextInMemory {
 public:
  explicit TextInMemory(const char* name) : fd_(::memfd_create(name, MFD_CLOEXEC)) {
    if (fd_ < 0) throw std::runtime_error("this computer has no memory left to start a command");
  }
  ~TextInMemory() { ::close(fd_); }
  TextInMemory(const TextInMemory&) = delete;
  TextInMemory& operator=(const TextInMemory&) = delete;

  int fd() const { return fd_; }
  void fill(const std::string& text) const {
    std::size_t done = 0;
    while (done < text.size()) {
      const ssize_t count =
          ::pwrite(fd_, text.data() + done, text.size() - done, static_cast<off_t>(done));
      if (count < 0 && errno == EINTR) continue;
      if (count <= 0) throw std::runtime_error("this computer has no memory left for a command");
      done += static_cast<std::size_t>(count);
    }
  }
  std::string text() const {
    std::string all;
    char bytes[65536];
    for (;;) {
      const ssize_t count = ::pread(fd_, bytes, sizeof bytes, static_cast<off_t>(all.size()));
      if (count < 0 && errno == EINTR) continue;
      if (count <= 0) return all;
      all.append(bytes, static_cast<std::size_t>(count));
    }
  }

 private:
  int fd_;
};

void limit(__rlimit_resource what, std::size_t value) {
  const rlimit both{value, value};
  ::setrlimit(what, &both);
}

// Runs in the child and never returns. Only calls that a process may make which had several threads.
[[noreturn]] void become(char* const* words, const char* program, const char* folder,
                         const ChildLimits& limits, int in, int out, int err, pid_t parent) {
  ::setpgid(0, 0);  // Ctrl-C is for the parent
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(126);  // it has ended already
  for (const int number : {SIGXFSZ, SIGPIPE, SIGINT, SIGTERM, SIGHUP, SIGTSTP, SIGTTOU}) {
    ::signal(number, SIG_DFL);
  }
  if (::chdir(folder) != 0) ::_exit(126);
  ::dup2(in, STDIN_FILENO);
  ::dup2(out, STDOUT_FILENO);
  ::dup2(err, STDERR_FILENO);
  ::close_range(3, ~0U, 0);
  limit(RLIMIT_CPU, limits.processor_s);
  limit(RLIMIT_FSIZE, limits.file_B);
  limit(RLIMIT_CORE, 0);
#ifndef __SANITIZE_ADDRESS__  // whose shadow counts as memory
  limit(RLIMIT_DATA, limits.memory_B);
#endif
  ::execv(program, words);
  ::_exit(127);
}

std::string signal_text(int number, const ChildLimits& limits) {
  if (number == SIGXCPU || number == SIGKILL) {
    return "took more than " + std::to_string(limits.processor_s) + " s of processor time";
  }
  if (number == SIGXFSZ) {
    return "wrote more than " + std::to_string(limits.file_B >> 20) + " MiB";
  }
  return "was ended by signal " + std::to_string(number);
}

}  // namespace

ChildEnd run_child(const std::string& program, const std::vector<std::string>& words,
                   const std::filesystem::path& folder, const ChildLimits& limits,
                   const std::atomic<bool>& is_closing, const std::string& input) {
  const TextInMemory in("viscard-in"), out("viscard-out"), err("viscard-err");
  in.fill(input);
  std::string name = "viscard";
  std::vector<std::string> kept = words;
  std::vector<char*> arguments{name.data()};
  for (std::string& word : kept) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  const pid_t self = ::getpid(), child = ::fork();
  if (child < 0) throw std::runtime_error("this computer has no process left for a command");
  if (child == 0) {
    become(arguments.data(), program.c_str(), folder.c_str(), limits, in.fd(), out.fd(), err.fd(),
           self);
  }
  const auto end = ChildClock::now() + limits.clock;
  int status = 0;
  std::string trouble;
  while (::waitpid(child, &status, WNOHANG) == 0) {
    if (is_closing || ChildClock::now() > end) {
      trouble = is_closing ? "was ended, because this program ends"
                           : "took more than " + std::to_string(limits.clock.count()) + " s";
      ::kill(child, SIGKILL);
      ::waitpid(child, &status, 0);
      break;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  ChildEnd ended{.out = out.text(), .err = err.text(), .trouble = trouble};
  if (!trouble.empty()) return ended;
  if (WIFEXITED(status)) ended.status = WEXITSTATUS(status);
  if (WIFSIGNALED(status)) ended.trouble = signal_text(WTERMSIG(status), limits);
  return ended;
}

}  // namespace viscard
