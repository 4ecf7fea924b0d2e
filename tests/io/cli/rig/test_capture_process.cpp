// The viscard program itself, killed, interrupted and starved in the middle of a run.
#include "io/basics/atomic_file.h"
#include "io/capture/capture_file.h"
#include "rig/emulator/demo_rig.h"
#include "rig/emulator/emulated_rig.h"
#include "tests/support/error_text.h"
#include "tests/support/scratch_folder.h"

#include <catch2/catch.hpp>
#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <functional>
#include <iostream>
#include <optional>
#include <random>
#include <string>
#include <thread>
#include <vector>

namespace viscard {
namespace {

using test::contains;
using test::ScratchFolder;

// A viscard process; its stderr is kept.
class Program {
 public:
  explicit Program(std::vector<std::string> words, rlim_t most_bytes = RLIM_INFINITY) {
    int ends[2];
    REQUIRE(::pipe(ends) == 0);
    child_ = ::fork();
    REQUIRE(child_ >= 0);
    if (child_ == 0) {
      const rlimit limit{most_bytes, most_bytes};
      if (most_bytes != RLIM_INFINITY) ::setrlimit(RLIMIT_FSIZE, &limit);
      ::dup2(ends[1], STDERR_FILENO);
      ::dup2(::open("/dev/null", O_WRONLY), STDOUT_FILENO);
      std::vector<char*> arguments{const_cast<char*>(VISCARD_PROGRAM)};
      for (std::string& word : words) arguments.push_back(word.data());
      arguments.push_back(nullptr);
      ::execv(VISCARD_PROGRAM, arguments.data());
      _exit(99);
    }
    ::close(ends[1]);
    stderr_ = ends[0];
    ::fcntl(stderr_, F_SETFL, O_NONBLOCK);
  }
  ~Program() {
    if (!status_) ::kill(child_, SIGKILL);
    wait();
    ::close(stderr_);
  }
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  void send(int signal_number) { ::kill(child_, signal_number); }
  int wait() {
    if (!status_) {
      while (!has_ended()) std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    said();
    return *status_;
  }
  bool has_ended() {
    said();
    int status = 0;
    if (!status_ && ::waitpid(child_, &status, WNOHANG) == child_) status_ = status;
    return status_.has_value();
  }
  const std::string& said() {
    char buffer[4096];
    ssize_t n = 0;
    while ((n = ::read(stderr_, buffer, sizeof buffer)) > 0) {
      said_.append(buffer, static_cast<std::size_t>(n));
    }
    return said_;
  }

 private:
  pid_t child_ = -1;
  int stderr_ = -1;
  std::string said_;
  std::optional<int> status_;
};

constexpr const char* kTest = R"(
[approach]
speed = "0.1 mm/s"
baseline = "1 s"
[ramp]
depth = "0.13 mm"
duration = "1 s"
hold = "20 s"
)";

// An emulated rig in this process that outlives the program under test.
struct OutsideRig {
  explicit OutsideRig(double surface_m) : emulated(options(surface_m)) {
    std::string text = read_file(VISCARD_SOURCE_DIR "/data/demo/01_rig.toml");
    replace(text, "/dev/serial/by-id/stage", emulated.stage_port());
    replace(text, "/dev/serial/by-id/load_cell", emulated.load_cell_port());
    write_file(folder / "rig.toml", text, false);
    write_file(folder / "test.toml", kTest, false);
  }
  static EmulatedRigOptions options(double surface_m) {
    EmulatedRigOptions result;
    result.truth = demo_truth(10.0, 3);
    result.truth.surface_position_m = surface_m;
    result.config = demo_rig();
    return result;
  }
  static void replace(std::string& text, const std::string& what, const std::string& by) {
    text.replace(text.find(what), what.size(), by);
  }
  std::vector<std::string> words(const std::string& out = "run.viscap") const {
    return {"capture",
            "--rig",
            folder / "rig.toml",
            "--test",
            folder / "test.toml",
            "--specimen",
            VISCARD_SOURCE_DIR "/data/demo/03_pdms_1to10.toml",
            "--out",
            folder / out};
  }
  // True once it holds, false if the program ended first.
  bool wait_for(Program& program, const std::function<bool()>& is_there) const {
    while (!is_there()) {
      if (program.has_ended()) return false;
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    return true;
  }
  bool is_moving_beyond(double position_m) const {
    const EmulatedOutcome bench = emulated.outcome();
    return bench.is_moving && bench.final_position_m > position_m;
  }

  ScratchFolder folder;
  EmulatedRig emulated;
};

std::size_t records_in(const std::filesystem::path& path) {
  const CapturedRun run = read_capture(path);
  std::size_t n =
      run.load_samples.size() + run.stage_reports.size() + run.moves.size() + run.events.size();
  read_raw_bytes(path, [&n](const RawBytes&) { ++n; });
  return n;
}

// The number of the last "123 records are safe from a crash, 98 from a power cut".
std::size_t last_acknowledged(const std::string& said) {
  const std::size_t end = said.rfind(" records are safe");
  if (end == std::string::npos) return 0;
  const std::size_t begin = said.rfind('\n', end);
  return std::stoul(said.substr(begin == std::string::npos ? 0 : begin + 1, end));
}

void kill_captures(int n_kills) {
  const ScratchFolder folder;
  std::mt19937 random(11);
  std::size_t acknowledged = 0, found = 0, lost = 0;
  int n_killed = 0;
  for (int i = 0; i < n_kills; ++i) {
    const auto path = folder / ("run" + std::to_string(i) + ".viscap");
    Program program({"capture", "--emulate", "--speed", "20", "--acknowledge", "--out", path});
    while (!program.has_ended() && last_acknowledged(program.said()) == 0) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    // At a random time of a run of some seconds.
    const int after_us = std::uniform_int_distribution<int>(0, 1'500'000)(random);
    std::this_thread::sleep_for(std::chrono::microseconds(after_us));
    program.send(SIGKILL);
    n_killed += WIFSIGNALED(program.wait()) ? 1 : 0;
    const std::size_t said = last_acknowledged(program.said());
    const std::size_t there = records_in(path);
    CHECK(contains(program.said(), " records are safe from a crash, "));
    CHECK(contains(program.said(), " from a power cut\n"));
    CHECK(read_capture(path).status == "interrupted");
    acknowledged += said;
    found += there;
    lost += said > there ? said - there : 0;
  }
  std::cout << n_killed << " captures killed: " << acknowledged << " records acknowledged, "
            << found << " found, " << lost << " lost\n";
  CHECK(n_killed == n_kills);
  CHECK(acknowledged > static_cast<std::size_t>(100 * n_kills));
  CHECK(lost == 0);
}

}  // namespace

TEST_CASE("5 captures killed at random moments lose nothing that was acknowledged",
          "[cli][capture][pty]") {
  kill_captures(5);
}

TEST_CASE("100 captures killed at random moments lose nothing that was acknowledged",
          "[cli][capture][pty][slow]") {
  kill_captures(100);
}

TEST_CASE("Ctrl-C and termination in a move stop the stage, lift the punch and keep the record",
          "[cli][capture][pty]") {
  const int signal_number = GENERATE(SIGINT, SIGTERM);
  OutsideRig rig(0.05e-3);
  Program program(rig.words());
  REQUIRE(rig.wait_for(program, [&] { return rig.is_moving_beyond(0.06e-3); }));
  program.send(signal_number);
  const int status = program.wait();
  INFO(program.said());
  CHECK(WIFEXITED(status));
  CHECK(WEXITSTATUS(status) == 1);
  CHECK(contains(program.said(), "interrupted"));
  CHECK_FALSE(rig.emulated.outcome().is_moving);
  CHECK(rig.emulated.outcome().final_position_m < 0.05e-3);
  CHECK(read_capture(rig.folder / "run.viscap").status == "interrupted");
}

TEST_CASE("after a capture is killed in its approach the stage stops within one jog",
          "[cli][capture][pty]") {
  OutsideRig rig(2e-3);
  Program program(rig.words());
  REQUIRE(rig.wait_for(program, [&] { return rig.is_moving_beyond(0.05e-3); }));
  program.send(SIGKILL);
  REQUIRE(WIFSIGNALED(program.wait()));
  const double killed_m = rig.emulated.outcome().final_position_m;
  std::this_thread::sleep_for(std::chrono::milliseconds(600));  // two jogs would take .5 s
  CHECK_FALSE(rig.emulated.outcome().is_moving);
  CHECK(rig.emulated.outcome().final_position_m < killed_m + 25e-6);
}

TEST_CASE("Ctrl-Z and a closed pipe do not prevent a run from ending well", "[cli][capture][pty]") {
  OutsideRig rig(0.05e-3);
  Program program(rig.words());
  REQUIRE(rig.wait_for(program, [&] { return rig.is_moving_beyond(0.03e-3); }));
  program.send(SIGTSTP);
  program.send(SIGPIPE);
  REQUIRE(rig.wait_for(program, [&] { return rig.is_moving_beyond(0.07e-3); }));
  program.send(SIGINT);
  CHECK(WIFEXITED(program.wait()));
  CHECK(rig.emulated.outcome().final_position_m < 0.05e-3);
}

TEST_CASE("a full disk ends the run safely and keeps all records before it",
          "[cli][capture][pty]") {
  const ScratchFolder folder;
  const auto path = folder / "run.viscap";
  Program program({"capture", "--emulate", "--speed", "20", "--out", path}, 200'000);
  const int status = program.wait();
  INFO(program.said());
  REQUIRE(WIFEXITED(status));
  CHECK(WEXITSTATUS(status) == 1);
  CHECK(contains(program.said(), "committed before are in the file"));
  CHECK(read_capture(path).status == "interrupted");
  CHECK(read_capture(path).load_samples.size() > 20);
}

TEST_CASE("two captures cannot share a port or a file", "[cli][capture][pty]") {
  OutsideRig rig(2e-3);
  Program first(rig.words());
  REQUIRE(rig.wait_for(first, [&] { return rig.emulated.outcome().is_moving; }));
  Program same_port(rig.words("other.viscap"));
  CHECK(WEXITSTATUS(same_port.wait()) == 1);
  CHECK(contains(same_port.said(), "in use by another program"));
  CHECK_FALSE(std::filesystem::exists(rig.folder / "other.viscap"));
  Program same_file({"capture", "--emulate", "--force", "--out", rig.folder / "run.viscap"});
  CHECK(WEXITSTATUS(same_file.wait()) == 1);
  CHECK(contains(same_file.said(), "is being written by another capture"));
  first.send(SIGINT);
  CHECK(WEXITSTATUS(first.wait()) == 1);
  CHECK(read_capture(rig.folder / "run.viscap").load_samples.size() > 20);
}

}  // namespace viscard
