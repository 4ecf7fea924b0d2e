#include "io/cards/targets/calculix_proof.h"

#include "io/basics/atomic_file.h"
#include "io/cards/card_lines.h"
#include "io/cards/deck.h"
#include "io/cards/targets/card_targets.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
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

void run_ccx(const std::filesystem::path& folder) {
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
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0 || log.find("*ERROR") != std::string::npos) {
    throw std::runtime_error("ccx stopped: " + first_error(log));
  }
}

struct Sample {
  double time = 0.0;
  double value = 0.0;  // last column of the last line: z force of the base, z of a top node
};

std::vector<Sample> samples_in(const std::string& dat) {
  std::vector<Sample> samples;
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

// The response after every increment, divided by the amplitude.
std::vector<Sample> run_test(const Card& card, const UnitSystem& units, const ElementTest& test) {
  const TemporaryFolder folder;
  const DeckInput input{card, test, units};
  std::ofstream(folder.path() / "deck.inp")
      << calculix_target().deck->files(input, "deck").front().text;
  run_ccx(folder.path());
  std::vector<Sample> samples = samples_in(read_file(folder.path() / "deck.dat"));
  if (samples.empty()) throw std::runtime_error("ccx ran but printed no result");
  const double scale = input.is_creep() ? test.amplitude : input.stress();
  for (Sample& sample : samples) {
    sample.time = from_card(sample.time, units.time_exponent);
    sample.value = std::abs(sample.value) / scale;
  }
  return samples;
}

// Pairs samples by time: ccx prints seven digits of it and takes an elastic step in one increment
// even if it should take more.
StepError compare(const std::vector<Sample>& coarse, const std::vector<Sample>& fine,
                  const Material& material, const ElementTest& test) {
  StepError error;
  auto half = fine.begin();
  for (const Sample& sample : coarse) {
    const double margin_s = 1e-6 * sample.time;
    while (half != fine.end() && half->time < sample.time - margin_s) ++half;
    // Only the hold is compared: the response to the first increments of the ramp is close to zero.
    if (sample.time < test.ramp_s * (1.0 - 1e-6)) continue;
    if (half == fine.end() || half->time > sample.time + margin_s) {
      throw std::runtime_error(
          fmt::format("ccx printed no result at {:g} s with the smaller step", sample.time));
    }
    const double expected = exact_response(material, test, sample.time);
    const double at_step = std::abs(sample.value / expected - 1.0);
    if (!(at_step <= error.at_step)) {
      error.at_step = at_step;
      error.worst_s = sample.time;
    }
    const double extrapolated = 2.0 * half->value - sample.value;
    error.remaining = std::max(error.remaining, std::abs(extrapolated / expected - 1.0));
  }
  return error;
}

}  // namespace

bool StepError::vanishes_with_step() const {
  return remaining <= std::max(1e-4, 0.125 * at_step);
}

CalculixProof prove_in_calculix(const std::string& card_text, const Material& material,
                                const UnitSystem& units, int steps_per_tau) {
  CalculixProof proof;
  const Card card{.text = card_text, .written = material};
  const auto run = [&](ElementTestKind kind) {
    ElementTestOptions options = calculix_target().deck->test;
    options.kind = kind;
    options.steps_per_tau = steps_per_tau;
    ElementTest test = element_test(material, options);
    const std::vector<Sample> coarse = run_test(card, units, test);
    for (TimeBlock& block : test.blocks) block.increments *= 2;
    const std::vector<Sample> fine = run_test(card, units, test);
    proof.end_s = test.end_s();
    proof.increments = static_cast<int>(coarse.size());
    return compare(coarse, fine, material, test);
  };
  proof.relaxation = run(ElementTestKind::kRelaxation);
  proof.creep = run(ElementTestKind::kCreep);
  return proof;
}

}  // namespace viscard
