#pragma once

#include "io/basics/atomic_file.h"
#include "rig/emulator/demo_rig.h"
#include "rig/emulator/emulated_rig.h"
#include "tests/support/scratch_folder.h"

#include <catch2/catch.hpp>
#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace viscard {

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

inline constexpr const char* kTest = R"(
[approach]
speed = "0.1 mm/s"
baseline = "1 s"
[ramp]
depth = "0.13 mm"
duration = "1 s"
hold = "20 s"
)";

// An emulated rig on the wall clock in this process, for the program under test in another.
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
    result.is_on_wall_clock = true;
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
            std::string(VISCARD_SOURCE_DIR) + "/data/demo/03_pdms_1to10.toml",
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

  test::ScratchFolder folder;
  EmulatedRig emulated;
};

}  // namespace viscard
