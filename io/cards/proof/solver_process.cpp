#include "io/basics/atomic_file.h"
#include "io/cards/card.h"
#include "io/cards/proof/solver.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <stdexcept>
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

// Removed with its files by the destructor.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string pattern =
        (std::filesystem::temp_directory_path() / "viscard-proof-XXXXXX").string();
    if (::mkdtemp(pattern.data()) == nullptr) {
      throw std::runtime_error("cannot make a folder in " +
                               std::filesystem::temp_directory_path().string());
    }
    path_ = pattern;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

// Runs in the child process and never returns. Everything printed is added to the file "log".
[[noreturn]] void become(const std::vector<std::string>& command,
                         const std::filesystem::path& folder, const RunLimits& limits) {
  if (::chdir(folder.c_str()) != 0) ::_exit(126);
  const int log = ::open("log", O_WRONLY | O_CREAT | O_APPEND, 0644);
  const int nothing = ::open("/dev/null", O_RDONLY);
  ::dup2(nothing, STDIN_FILENO);
  ::dup2(log, STDOUT_FILENO);
  ::dup2(log, STDERR_FILENO);
  ::setenv("OMP_NUM_THREADS", "1", 1);
  const rlimit processor{limits.processor_s, limits.processor_s + 1};
  ::setrlimit(RLIMIT_CPU, &processor);
  std::vector<char*> words;
  for (const std::string& word : command) words.push_back(const_cast<char*>(word.c_str()));
  words.push_back(nullptr);
  ::execvp(words[0], words.data());
  ::_exit(127);
}

// The status of waitpid, or nothing if it took too long and was stopped.
std::optional<int> status_of(const std::vector<std::string>& command,
                             const std::filesystem::path& folder, const RunLimits& limits) {
  const pid_t child = ::fork();
  if (child < 0) throw std::runtime_error("cannot start " + command[0] + ": no process left");
  if (child == 0) become(command, folder, limits);
  int status = 0;
  const auto started = std::chrono::steady_clock::now();
  while (::waitpid(child, &status, WNOHANG) == 0) {
    if (std::chrono::steady_clock::now() - started > limits.clock) {
      ::kill(child, SIGKILL);
      ::waitpid(child, &status, 0);
      return std::nullopt;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
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
    const std::string log = read_file(folder / "log");
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
  const TemporaryFolder folder;
  for (const DeckFile& file : files) std::ofstream(folder.path() / file.name) << file.text;
  const bool has_finished = run_commands(found, folder.path());
  read(folder.path());
  return has_finished;
}

std::string printed_by(const std::string& program, const std::vector<std::string>& words) {
  const TemporaryFolder folder;
  std::vector<std::string> command{program};
  command.insert(command.end(), words.begin(), words.end());
  const std::optional<int> status = status_of(command, folder.path(), kVersionLimits);
  const bool has_run = status && WIFEXITED(*status) && WEXITSTATUS(*status) != 127;
  return has_run ? read_file(folder.path() / "log") : "";
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
