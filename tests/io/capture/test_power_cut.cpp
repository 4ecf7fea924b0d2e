// What a power cut leaves of captures and other outputs, on a disk that keeps only what was synced.
#include "io/basics/atomic_file.h"
#include "io/capture/capture_file.h"
#include "io/capture/sync_schedule.h"
#include "tests/io/capture/capture_samples.h"
#include "tests/support/error_text.h"
#include "tests/support/power_cut.h"
#include "tests/support/scratch_folder.h"

#include <catch2/catch.hpp>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <set>
#include <vector>

namespace viscard {
namespace {

using test::contains;
using test::demo_run;
using test::error_text;
using test::LossyDisk;
using test::sample;
using test::ScratchFolder;

// From this state of the disk on, that many samples must be there.
struct Promise {
  std::size_t state = 0, n_samples = 0;
};

std::set<std::string> names_in(const std::filesystem::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    names.insert(entry.path().filename().string());
  }
  return names;
}

TEST_CASE("a capture keeps every synced record through a power cut at any sync", "[io][capture]") {
  const ScratchFolder folder;
  const LossyDisk disk(folder.path());
  std::vector<Promise> promises;
  {
    CaptureWriter writer(folder / "run.viscap", demo_run());
    promises.push_back({disk.n_states() - 1, 0});
    for (int i = 0; i < 300; ++i) {
      writer.append(sample(i));
      if (i % 25 != 24) continue;
      writer.sync();
      promises.push_back({disk.n_states() - 1, writer.counts().synced});
    }
    writer.finish("finished");
  }
  promises.push_back({disk.n_states() - 1, 300});
  for (std::size_t state = promises.front().state; state < disk.n_states(); ++state) {
    const ScratchFolder after;
    disk.restore(state, after.path());
    std::size_t n_promised = 0;
    for (const Promise& promise : promises) {
      if (promise.state <= state) n_promised = promise.n_samples;
    }
    CHECK(read_capture(after / "run.viscap").load_samples.size() >= n_promised);
  }
  CHECK(promises.back().state > 14);
}

TEST_CASE("a power cut after the end of a capture leaves the finished file alone",
          "[io][capture]") {
  const ScratchFolder folder;
  const LossyDisk disk(folder.path());
  CaptureWriter writer(folder / "run.viscap", demo_run());
  for (int i = 0; i < 50; ++i) writer.append(sample(i));
  writer.finish("finished");
  const ScratchFolder after;
  disk.restore(disk.n_states() - 1, after.path());
  CHECK(names_in(after.path()) == std::set<std::string>{"run.viscap"});
  CHECK(read_capture(after / "run.viscap").status == "finished");
}

TEST_CASE("a journal of the creation does not return during the run", "[io][capture]") {
  const ScratchFolder folder;
  const LossyDisk disk(folder.path());
  CaptureWriter writer(folder / "run.viscap", demo_run());
  const ScratchFolder after;
  disk.restore(disk.n_states() - 1, after.path());
  CHECK(names_in(after.path()).count("run.viscap-journal") == 0);
}

TEST_CASE("a file that is replaced is the old or the new one after a power cut", "[io]") {
  const ScratchFolder folder;
  write_file(folder / "material.json", "old", false);
  const LossyDisk disk(folder.path());
  write_file(folder / "material.json", "new", true);
  for (std::size_t state = 0; state < disk.n_states(); ++state) {
    const ScratchFolder after;
    disk.restore(state, after.path());
    const std::string text = read_file(after / "material.json");
    CHECK((text == "old" || (state > 0 && text == "new")));
    if (state + 1 == disk.n_states()) CHECK(text == "new");
  }
}

TEST_CASE("a folder that cannot be synced is an error", "[io]") {
  const ScratchFolder folder;
  LossyDisk disk(folder.path());
  disk.fail_folder_syncs(EIO);
  CHECK(contains(error_text([&] { write_file(folder / "material.json", "new", false); }),
                 "cannot sync this folder"));
  CHECK(contains(error_text([&] { CaptureWriter writer(folder / "run.viscap", demo_run()); }),
                 "cannot sync this folder"));
  CHECK(contains(error_text([&] { sync_folder(folder / "missing"); }), "No such file"));
  disk.fail_folder_syncs(EINVAL);  // a file system that has no such thing
  CHECK_NOTHROW(write_file(folder / "other.json", "new", false));
}

pid_t ended_process() {
  const pid_t child = ::fork();
  if (child == 0) _exit(0);
  ::waitpid(child, nullptr, 0);
  return child;
}

TEST_CASE("temporary files that a power cut has left are removed by the next run", "[io]") {
  const ScratchFolder outputs;
  const auto leave = [&](const std::string& name, pid_t writer) {
    std::string file = "." + name + "." + std::to_string(writer) + ".tmp";
    std::ofstream(outputs / file) << "half";
    return file;
  };
  const std::string gone = leave("material.json", ended_process());
  const std::string live = leave("material.json", ::getppid());
  const std::string other = leave("card.inp", ended_process());
  write_file(outputs / "material.json", "new", false);
  CHECK(names_in(outputs.path()) == std::set<std::string>{"material.json", live, other});
  write_file(outputs / "card.inp", "new", false);
  CHECK(names_in(outputs.path()) == std::set<std::string>{"material.json", "card.inp", live});
}

TEST_CASE("a slow disk is synced earlier by the time that its last sync took", "[io][capture]") {
  SyncSchedule schedule(0.5, 0.05, 10.0);
  CHECK_FALSE(schedule.is_due(10.44));
  CHECK(schedule.is_due(10.46));
  schedule.synced(10.5, 10.51);
  CHECK_FALSE(schedule.is_due(10.93));
  CHECK(schedule.is_due(10.95));
  // Records of 10.9 s, just after the begin of a sync of 0.2 s, are safe at 11.4 s.
  schedule.synced(10.9, 11.1);
  CHECK(schedule.is_due(11.16));
  // More than half of the interval: at once.
  schedule.synced(11.2, 11.5);
  CHECK(schedule.is_due(11.5));
}

}  // namespace
}  // namespace viscard
