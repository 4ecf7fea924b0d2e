#include "io/capture/capture_file.h"
#include "tests/io/capture/capture_samples.h"
#include "tests/support/error_text.h"
#include "tests/support/scratch_folder.h"

#include <catch2/catch.hpp>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <iostream>
#include <random>
#include <thread>

namespace viscard {
namespace {

using test::contains;
using test::demo_run;
using test::error_text;
using test::sample;
using test::ScratchFolder;

// The child process: appends samples as fast as a quick load cell and reports over a pipe how many
// the writer has acknowledged. Never returns.
[[noreturn]] void capture_until_killed(const std::filesystem::path& path, int pipe_end) {
  CaptureWriter writer(path, demo_run(), {.commit_interval_s = 0.005, .sync_interval_s = 0.02});
  for (std::int64_t i = 0;; ++i) {
    writer.append(sample(i));
    if (i % 100 == 99) writer.append(RunEvent{0.0, "phase", "hold", ""});
    if (i % 500 == 499) writer.sync();
    const std::size_t committed = writer.counts().committed;
    if (::write(pipe_end, &committed, sizeof committed) < 0) _exit(3);
    if (i % 16 == 0) std::this_thread::sleep_for(std::chrono::microseconds(300));
  }
}

struct KillOutcome {
  std::size_t acknowledged = 0, found = 0;
};

KillOutcome kill_once(const ScratchFolder& folder, int number, int after_us) {
  const auto path = folder / ("run" + std::to_string(number) + ".viscap");
  int ends[2];
  REQUIRE(::pipe(ends) == 0);
  const pid_t child = ::fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    ::close(ends[0]);
    try {
      capture_until_killed(path, ends[1]);
    } catch (...) {
      _exit(4);
    }
  }
  ::close(ends[1]);
  KillOutcome outcome;
  // Killed at a random time after its first report, so that it is writing at that moment.
  std::size_t word = 0;
  REQUIRE(::read(ends[0], &word, sizeof word) == sizeof word);
  std::thread killer([&] {
    std::this_thread::sleep_for(std::chrono::microseconds(after_us));
    ::kill(child, SIGKILL);
  });
  do {
    outcome.acknowledged = word;
  } while (::read(ends[0], &word, sizeof word) == sizeof word);
  killer.join();
  ::close(ends[0]);
  int status = 0;
  ::waitpid(child, &status, 0);
  REQUIRE(WIFSIGNALED(status));

  const CapturedRun run = read_capture(path);
  CHECK(run.status == "interrupted");
  outcome.found = run.load_samples.size() + run.events.size();
  for (std::size_t i = 0; i < run.load_samples.size(); ++i) {
    REQUIRE(run.load_samples[i].index == static_cast<std::int64_t>(i));  // no hole, none twice
    REQUIRE(run.load_samples[i].counts == 1000.0 + static_cast<double>(i));
  }
  return outcome;
}

TEST_CASE("a hundred kills at random moments lose no acknowledged record", "[io][capture]") {
  const ScratchFolder folder;
  std::mt19937 random(20261121);
  std::uniform_int_distribution<int> after_us(0, 60'000);
  std::size_t acknowledged = 0, found = 0, lost = 0;
  for (int i = 0; i < 100; ++i) {
    const KillOutcome outcome = kill_once(folder, i, after_us(random));
    acknowledged += outcome.acknowledged;
    found += outcome.found;
    if (outcome.found < outcome.acknowledged) lost += outcome.acknowledged - outcome.found;
  }
  std::cout << "100 kills: " << acknowledged << " records acknowledged, " << found << " found, "
            << lost << " lost\n";
  CHECK(acknowledged > 1000);  // else the kills came before anything was at stake
  CHECK(lost == 0);
}

TEST_CASE("a disk that fills up ends the capture with an error and keeps what was committed",
          "[io][capture]") {
  const ScratchFolder folder;
  const auto path = folder / "run.viscap";
  const pid_t child = ::fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    ::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{300'000, 300'000};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    CaptureWriter writer(path, demo_run());
    try {
      for (std::int64_t i = 0; i < 1'000'000; ++i) {
        writer.append(sample(i));
        if (i % 100 == 99) writer.sync();
      }
    } catch (const std::runtime_error& error) {
      const bool is_clear = contains(error.what(), "disk") &&
                            contains(error.what(), "committed before are in the file");
      const bool is_kept = !error_text([&] { writer.append(sample(0)); }).empty() &&
                           !error_text([&] { writer.finish("finished"); }).empty();
      _exit(is_clear && is_kept ? 0 : 5);
    }
    _exit(6);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  REQUIRE(WIFEXITED(status));
  CHECK(WEXITSTATUS(status) == 0);
  const CapturedRun run = read_capture(path);
  CHECK(run.status == "interrupted");
  CHECK(run.load_samples.size() >= 100);
}

TEST_CASE("a capture that another process is writing is neither shared nor replaced",
          "[io][capture]") {
  const ScratchFolder folder;
  const auto path = folder / "run.viscap";
  int ends[2];
  REQUIRE(::pipe(ends) == 0);
  const pid_t child = ::fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    CaptureWriter writer(path, demo_run());
    writer.append(sample(0));
    writer.sync();
    const bool is_told = ::write(ends[1], "x", 1) == 1;
    ::pause();
    _exit(is_told ? 0 : 1);
  }
  char word = 0;
  REQUIRE(::read(ends[0], &word, 1) == 1);
  CHECK(contains(error_text([&] { CaptureWriter second(path, demo_run(), {.overwrite = true}); }),
                 "is being written by another capture"));
  const CapturedRun run = read_capture(path);
  CHECK(run.status == "running");
  CHECK(run.load_samples.size() == 1);
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
  CHECK(read_capture(path).status == "interrupted");
  ::close(ends[0]);
  ::close(ends[1]);
}

}  // namespace
}  // namespace viscard
