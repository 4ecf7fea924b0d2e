// The viscard program itself, killed, interrupted and starved in the middle of a run.
#include "io/capture/capture_file.h"
#include "tests/io/cli/rig/outside_rig.h"
#include "tests/support/error_text.h"

#include <catch2/catch.hpp>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <iostream>
#include <random>
#include <string>
#include <thread>
#include <vector>

namespace viscard {
namespace {

using test::contains;
using test::ScratchFolder;

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

TEST_CASE("a capture that is frozen while it presses names the computer", "[cli][capture][pty]") {
  for (int tries = 1;; ++tries) {
    OutsideRig rig(0.05e-3);
    Program program(rig.words());
    const bool is_in_ramp = rig.wait_for(program, [&] { return rig.is_moving_beyond(0.1e-3); });
    if (is_in_ramp) {
      program.send(SIGSTOP);
      std::this_thread::sleep_for(std::chrono::milliseconds(800));
      program.send(SIGCONT);
    }
    const int status = program.wait();
    INFO(program.said());
    REQUIRE(WIFEXITED(status));
    CHECK(WEXITSTATUS(status) == 1);
    CHECK(contains(program.said(), "this computer was late by "));
    CHECK_FALSE(contains(program.said(), "modulus_guess"));
    CHECK_FALSE(rig.emulated.outcome().is_moving);
    CHECK(rig.emulated.outcome().final_position_m < 0.05e-3);
    if (is_in_ramp) return;
    REQUIRE(tries < 10);  // a busy computer is late by itself, before the ramp
  }
}

TEST_CASE("a frozen capture of the emulated rig is the capture that was not frozen",
          "[cli][capture][pty]") {
  const ScratchFolder folder;
  write_file(folder / "test.toml", kTest, false);
  const auto words = [&](const std::string& out, const std::string& speed) {
    return std::vector<std::string>{"capture", "--emulate", "--test", folder / "test.toml",
                                    "--speed", speed,       "--out",  folder / out};
  };
  Program frozen(words("frozen.viscap", "20"));
  for (int i = 0; i < 6; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(150));
    frozen.send(SIGSTOP);
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    frozen.send(SIGCONT);
  }
  Program plain(words("plain.viscap", "500"));
  CHECK(WEXITSTATUS(frozen.wait()) == 0);
  CHECK(WEXITSTATUS(plain.wait()) == 0);
  const CapturedRun one = read_capture(folder / "frozen.viscap");
  const CapturedRun other = read_capture(folder / "plain.viscap");
  REQUIRE(one.load_samples.size() == other.load_samples.size());
  CHECK(one.n_raw_bytes == other.n_raw_bytes);
  for (std::size_t i = 0; i < one.load_samples.size(); ++i) {
    REQUIRE(one.load_samples[i].host_time_s == other.load_samples[i].host_time_s);
    REQUIRE(*one.load_samples[i].counts == *other.load_samples[i].counts);
  }
}

}  // namespace viscard
