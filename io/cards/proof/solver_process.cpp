#include "io/basics/atomic_file.h"
#include "io/basics/temporary_folder.h"
#include "io/cards/card.h"
#include "io/cards/proof/solver.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <thread>
#include <utility>

namespace viscard {
namespace {

// Processor time ends a run that computes for too long, however busy the computer is; the clock ends
// one that waits for something.
struct RunLimits {
  rlim_t processor_s = 0;
  std::chrono::seconds clock{0};
};
constexpr RunLimits kRunLimits{600, std::chrono::hours(2)};
constexpr RunLimits kVersionLimits{30, std::chrono::minutes(2)};
// A model of one element writes a few MB. A solver that repeats a warning for ever fills the disk.
constexpr std::uintmax_t kMostBytesOfFile = std::uintmax_t{64} << 20;
constexpr std::uintmax_t kMostBytesOfFolder = std::uintmax_t{256} << 20;

// What a solver may need from the environment. A name that ends in '*' stands for all that begin so.
constexpr const char* kPassedOn[] = {"PATH",
                                     "HOME",
                                     "USER",
                                     "LOGNAME",
                                     "LANG",
                                     "LC_*",
                                     "TZ",
                                     "PYTHON*",
                                     "VIRTUAL_ENV",
                                     "CONDA_PREFIX",
                                     "LD_LIBRARY_PATH",
                                     "OMPI_*",
                                     "OPAL_*",
                                     "RAD_*",
                                     "OPENRADIOSS*",
                                     "LM_LICENSE_FILE"};

// "NAME=value" of what is passed on.
std::vector<std::string> passed_environment(const std::filesystem::path& folder) {
  std::vector<std::string> passed{"OMP_NUM_THREADS=1", "TMPDIR=" + folder.string()};
  for (char** entry = environ; entry != nullptr && *entry != nullptr; ++entry) {
    const std::string_view text = *entry;
    const std::string_view name = text.substr(0, text.find('='));
    const bool is_passed =
        std::any_of(std::begin(kPassedOn), std::end(kPassedOn), [&](std::string_view wanted) {
          return wanted.ends_with('*') ? name.starts_with(wanted.substr(0, wanted.size() - 1))
                                       : name == wanted;
        });
    if (is_passed) passed.emplace_back(text);
  }
  return passed;
}

std::atomic<int> caught_signal{0};

void keep_signal(int signal) {
  caught_signal = signal;
}

// While it lives, SIGINT, SIGTERM and SIGHUP do not end this process at once, so that solver and folder can
// be removed; its destructor hands them on to whoever handled them before. Ignored signals stay ignored.
class EndAfterCleaning {
 public:
  EndAfterCleaning() {
    caught_signal = 0;
    for (const int signal : kSignals) {
      struct sigaction old {
      }, ours{};
      if (::sigaction(signal, nullptr, &old) != 0 || old.sa_handler == SIG_IGN) continue;
      ours.sa_handler = keep_signal;
      ::sigaction(signal, &ours, nullptr);
      changed_.emplace_back(signal, old);
    }
  }
  ~EndAfterCleaning() {
    for (const auto& [signal, old] : changed_) ::sigaction(signal, &old, nullptr);
    const int signal = caught_signal.exchange(0);
    if (signal != 0) ::raise(signal);
  }
  EndAfterCleaning(const EndAfterCleaning&) = delete;
  EndAfterCleaning& operator=(const EndAfterCleaning&) = delete;

 private:
  static constexpr int kSignals[] = {SIGINT, SIGTERM, SIGHUP};
  std::vector<std::pair<int, struct sigaction>> changed_;
};

std::uintmax_t size_of_folder(const std::filesystem::path& folder) {
  std::uintmax_t size = 0;
  std::error_code error;
  for (std::filesystem::recursive_directory_iterator entry(folder, error), end;
       !error && entry != end; entry.increment(error)) {
    std::error_code ignored;
    const std::uintmax_t of_file = entry->file_size(ignored);
    if (!ignored) size += of_file;
  }
  return size;
}

// Runs in the child process and never returns. Everything printed is added to the file "log". The child
// leads a process group of its own, with what it starts, and ends when the parent does.
[[noreturn]] void become(const std::vector<std::string>& command,
                         const std::filesystem::path& folder, const RunLimits& limits,
                         pid_t parent) {
  ::setpgid(0, 0);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(126);  // it has ended already
  for (const int signal : {SIGXFSZ, SIGPIPE, SIGINT, SIGTERM, SIGHUP}) ::signal(signal, SIG_DFL);
  if (::chdir(folder.c_str()) != 0) ::_exit(126);
  const int log = ::open("log", O_WRONLY | O_CREAT | O_APPEND, 0644);
  const int nothing = ::open("/dev/null", O_RDONLY);
  ::dup2(nothing, STDIN_FILENO);
  ::dup2(log, STDOUT_FILENO);
  ::dup2(log, STDERR_FILENO);
  ::close_range(3, ~0U, 0);
  const rlimit processor{limits.processor_s, limits.processor_s + 1};
  ::setrlimit(RLIMIT_CPU, &processor);
  const rlimit file{kMostBytesOfFile, kMostBytesOfFile}, core{0, 0};
  ::setrlimit(RLIMIT_FSIZE, &file);
  ::setrlimit(RLIMIT_CORE, &core);
  std::vector<std::string> environment = passed_environment(folder);
  std::vector<char*> entries;
  for (std::string& entry : environment) entries.push_back(entry.data());
  entries.push_back(nullptr);
  environ = entries.data();
  std::vector<char*> words;
  for (const std::string& word : command) words.push_back(const_cast<char*>(word.c_str()));
  words.push_back(nullptr);
  ::execvp(words[0], words.data());
  ::_exit(127);
}

[[noreturn]] void fail_of_size(const std::string& program) {
  throw std::runtime_error(
      program + " wrote more than " + std::to_string(kMostBytesOfFile >> 20) +
      " MiB into a file, or " + std::to_string(kMostBytesOfFolder >> 20) +
      " MiB in all, and was stopped; run the deck by hand to see its messages");
}

// A process that ends a process group once this program is gone, also by kill -9: the death signal of the group's leader
// does not reach what a script has started.
class GroupGuard {
 public:
  explicit GroupGuard(pid_t group) {
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) return;
    guard_ = ::fork();
    if (guard_ == 0) watch(ends[0], group);
    ::close(ends[0]);
    written_ = ends[1];
  }
  ~GroupGuard() {
    if (written_ < 0) return;
    const ssize_t ignored = ::write(written_, "", 1);  // the group has ended as it should
    static_cast<void>(ignored);
    ::close(written_);
    if (guard_ > 0) ::waitpid(guard_, nullptr, 0);
  }
  GroupGuard(const GroupGuard&) = delete;
  GroupGuard& operator=(const GroupGuard&) = delete;

 private:
  // Only this end of the pipe stays open; the other one closes with the program.
  [[noreturn]] static void watch(int end, pid_t group) {
    ::setpgid(0, 0);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) ::signal(signal, SIG_IGN);
    ::dup2(end, STDIN_FILENO);
    ::close_range(1, ~0U, 0);
    char byte = 0;
    ssize_t n = 0;
    while ((n = ::read(STDIN_FILENO, &byte, 1)) < 0 && errno == EINTR) {
    }
    if (n == 0) ::kill(-group, SIGKILL);
    ::_exit(0);
  }

  pid_t guard_ = -1;
  int written_ = -1;
};

// The status of waitpid, or nothing if it took too long and was stopped. Nothing that it has started
// outlives it.
std::optional<int> status_of(const std::vector<std::string>& command,
                             const std::filesystem::path& folder, const RunLimits& limits) {
  const pid_t self = ::getpid(), child = ::fork();
  if (child < 0) throw std::runtime_error("cannot start " + command[0] + ": no process left");
  if (child == 0) become(command, folder, limits, self);
  ::setpgid(child, child);  // whoever comes first
  const GroupGuard guard(child);
  int status = 0;
  const auto end_all = [&] {
    ::kill(-child, SIGKILL);
    ::kill(child, SIGKILL);
  };
  const auto started = std::chrono::steady_clock::now();
  auto looked = started;
  while (::waitpid(child, &status, WNOHANG) == 0) {
    const auto now = std::chrono::steady_clock::now();
    const bool looks = now - looked > std::chrono::milliseconds(200);
    if (looks) looked = now;
    const bool is_large = looks && size_of_folder(folder) > kMostBytesOfFolder;
    if (now - started > limits.clock || caught_signal != 0 || is_large) {
      end_all();
      ::waitpid(child, &status, 0);
      if (is_large) fail_of_size(command[0]);
      if (caught_signal != 0) throw std::runtime_error(command[0] + " was stopped by a signal");
      return std::nullopt;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  ::kill(-child, SIGKILL);  // what it has left behind
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGXFSZ) fail_of_size(command[0]);
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU) return std::nullopt;
  return status;
}

// The log from the error's mark, or its last lines.
std::string end_of(const std::string& log, const char* mark) {
  const std::size_t at = *mark == '\0' ? std::string::npos : log.find(mark);
  const std::size_t from =
      at != std::string::npos ? at : log.size() - std::min<std::size_t>(log.size(), 200);
  std::string text;
  for (const char c : log.substr(from, 200)) text += c == '\n' ? ' ' : c;
  return text.empty() ? "no error message" : text.substr(0, text.find("   *"));
}

// False if the solution diverged.
bool run_commands(const FoundSolver& found, const std::filesystem::path& folder) {
  const Solver& solver = found.solver;
  for (const std::vector<std::string>& command : solver.commands(found.program)) {
    const std::optional<int> status = status_of(command, folder, kRunLimits);
    if (!status) {
      throw std::runtime_error(command[0] + " did not finish in 10 minutes of processor time");
    }
    if (WIFEXITED(*status) && WEXITSTATUS(*status) == 127) {
      throw std::runtime_error("cannot run " + command[0] + "; " + solver.install);
    }
    const std::string log = read_own_file(folder / "log");
    const auto has = [&](const char* mark) {
      return *mark != '\0' && log.find(mark) != std::string::npos;
    };
    if (has(solver.divergence)) return false;
    if (!WIFEXITED(*status) || WEXITSTATUS(*status) != 0 || has(solver.error)) {
      throw std::runtime_error(std::filesystem::path(command[0]).filename().string() +
                               " stopped: " + end_of(log, solver.error));
    }
  }
  return true;
}

// Response over the amplitude against time in s.
void scale_samples(const Solver& solver, const DeckInput& input, SolverRun& run) {
  const double in_SI = input.test.amplitude * input.card.written.E0_Pa;
  const double stress = solver.is_scaled ? input.stress() : in_SI;
  const double scale = input.is_creep() ? input.test.amplitude : stress;
  for (SolverSample& sample : run.samples) {
    if (solver.is_scaled) sample.time_s = from_card(sample.time_s, input.units.time_exponent);
    sample.value = std::abs(sample.value) / scale;
  }
}

std::vector<SolverRun> run_in_folder(const FoundSolver& found,
                                     const std::vector<SolverTask>& tasks) {
  const Solver& solver = found.solver;
  std::vector<SolverRun> runs;
  const auto read = [&](const std::filesystem::path& folder) {
    for (const SolverTask& task : tasks)
      runs.push_back({solver.samples(folder, task.input, runs.size())});
  };
  const bool has_diverged = !run_files(found, solver.model(tasks), read);
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    runs[i].diverged = has_diverged;
    if (runs[i].samples.empty() && !has_diverged) {
      throw std::runtime_error(solver.code + " ran but printed no result");
    }
    scale_samples(solver, tasks[i].input, runs[i]);
  }
  return runs;
}

}  // namespace

bool run_files(const FoundSolver& found, const std::vector<DeckFile>& files,
               const std::function<void(const std::filesystem::path&)>& read) {
  const EndAfterCleaning signals;
  const TemporaryFolder folder;
  for (const DeckFile& file : files) std::ofstream(folder.path() / file.name) << file.text;
  const bool has_finished = run_commands(found, folder.path());
  read(folder.path());
  return has_finished;
}

std::string printed_by(const std::string& program, const std::vector<std::string>& words) {
  const EndAfterCleaning signals;
  const TemporaryFolder folder;
  std::vector<std::string> command{program};
  command.insert(command.end(), words.begin(), words.end());
  const std::optional<int> status = status_of(command, folder.path(), kVersionLimits);
  const bool has_run = status && WIFEXITED(*status) && WEXITSTATUS(*status) != 127;
  return has_run ? read_own_file(folder.path() / "log") : "";
}

std::vector<SolverRun> run_solver(const FoundSolver& found, const std::vector<SolverTask>& tasks) {
  std::vector<SolverRun> runs;
  if (found.solver.runs_together) return run_in_folder(found, tasks);
  for (const SolverTask& task : tasks) {
    runs.push_back(run_in_folder(found, {task}).front());
    if (runs.back().diverged) break;
  }
  return runs;
}

}  // namespace viscard
