#include "io/cards/targets/calculix_run.h"

#include "io/basics/atomic_file.h"
#include "io/cards/card_lines.h"
#include "io/cards/deck.h"
#include "io/cards/targets/card_targets.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <thread>

namespace viscard {
namespace {

constexpr auto kLongestRun = std::chrono::minutes(10);

// Removed with its files by the destructor.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "viscard-ccx-XXXXXX").string();
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

// Runs in the child process and never returns.
[[noreturn]] void become_ccx(const std::filesystem::path& folder) {
  if (::chdir(folder.c_str()) != 0) ::_exit(126);
  const int log = ::open("log", O_WRONLY | O_CREAT | O_TRUNC, 0644);
  ::dup2(log, STDOUT_FILENO);
  ::dup2(log, STDERR_FILENO);
  ::setenv("OMP_NUM_THREADS", "1", 1);
  ::execlp("ccx", "ccx", "deck", static_cast<char*>(nullptr));
  ::_exit(127);
}

std::string first_error(const std::string& log) {
  const std::size_t at = log.find("*ERROR");
  if (at == std::string::npos) return "no error message";
  std::string text;
  for (const char c : log.substr(at, 200)) text += c == '\n' ? ' ' : c;
  return text.substr(0, text.find("   *"));
}

// False if the solution diverged.
bool run_ccx(const std::filesystem::path& folder) {
  const pid_t child = ::fork();
  if (child < 0) throw std::runtime_error("cannot start ccx: no process left");
  if (child == 0) become_ccx(folder);
  int status = 0;
  const auto started = std::chrono::steady_clock::now();
  while (::waitpid(child, &status, WNOHANG) == 0) {
    if (std::chrono::steady_clock::now() - started > kLongestRun) {
      ::kill(child, SIGKILL);
      ::waitpid(child, &status, 0);
      throw std::runtime_error("ccx did not finish in 10 minutes");
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  if (WIFEXITED(status) && WEXITSTATUS(status) == 127) {
    throw std::runtime_error("ccx is not installed; run: apt-get install calculix-ccx");
  }
  const std::string log = read_file(folder / "log");
  // checkconvergence.c: an increment that the creep law of a point could not solve.
  if (log.find("solution seems to diverge") != std::string::npos) return false;
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0 || log.find("*ERROR") != std::string::npos) {
    throw std::runtime_error("ccx stopped: " + first_error(log));
  }
  return true;
}

// Time and the last column of the last line: z force of the base, or z of a top node.
std::vector<SolverSample> samples_in(const std::string& dat) {
  std::vector<SolverSample> samples;
  std::istringstream stream(dat);
  for (std::string line; std::getline(stream, line);) {
    const std::size_t at = line.find("and time");
    if (at != std::string::npos) {
      samples.push_back({std::strtod(line.c_str() + at + 8, nullptr), 0.0});
    } else if (!trimmed(line).empty() && !samples.empty()) {
      samples.back().value = std::strtod(line.c_str() + line.find_last_of(' '), nullptr);
    }
  }
  return samples;
}

}  // namespace

SolverRun run_in_calculix(const Card& card, const UnitSystem& units, const ElementTest& test) {
  const TemporaryFolder folder;
  const DeckInput input{card, test, units};
  std::ofstream(folder.path() / "deck.inp")
      << calculix_target().deck->files(input, "deck").front().text;
  SolverRun run{.samples = {}, .diverged = !run_ccx(folder.path())};
  const std::filesystem::path printed = folder.path() / "deck.dat";
  if (std::filesystem::exists(printed)) run.samples = samples_in(read_file(printed));
  if (run.samples.empty() && !run.diverged) {
    throw std::runtime_error("ccx ran but printed no result");
  }
  const double scale = input.is_creep() ? test.amplitude : input.stress();
  for (SolverSample& sample : run.samples) {
    sample.time_s = from_card(sample.time_s, units.time_exponent);
    sample.value = std::abs(sample.value) / scale;
  }
  return run;
}

}  // namespace viscard
