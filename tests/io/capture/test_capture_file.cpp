#include "io/basics/atomic_file.h"
#include "io/basics/program.h"
#include "io/capture/capture_check.h"
#include "io/capture/capture_file.h"
#include "io/capture/capture_header.h"
#include "tests/io/capture/capture_samples.h"
#include "tests/support/error_text.h"
#include "tests/support/scratch_folder.h"

#include <catch2/catch.hpp>

#include <chrono>
#include <thread>

namespace viscard {
namespace {

using test::contains;
using test::demo_run;
using test::error_text;
using test::sample;
using test::ScratchFolder;

void write_one_of_each(CaptureWriter& writer) {
  writer.append(RunEvent{0.0, "phase", "approach", "the punch goes down"});
  writer.append(RawBytes{Device::kStage, true, 0.1, std::string("?\0\xff\n", 4)});
  writer.append(RawBytes{Device::kLoadCell, false, 0.2, "12500,1000\r\n"});
  writer.append(sample(0));
  LoadSample volts;
  volts.index = 1;
  volts.host_time_s = 1.0 / 3.0;
  volts.volts = -0.1;
  volts.is_saturated = true;
  volts.is_glitch = true;
  writer.append(volts);
  LoadSample gauge;
  gauge.index = 2;
  gauge.force_N = 1.0 / 7.0;
  writer.append(gauge);
  writer.append(StageReport{0.3, 1e-3 / 7.0, "Jog"});
  writer.append(CommandedMove{{0.25, 0.0, 1.5e-4, 1.3e-4, 0.2}, 0.02, "ramp"});
  writer.append(TemperatureSample{0.4, 23.0 + 1.0 / 3.0});
  writer.append(RawBytes{Device::kThermometer, false, 0.4, "T=23.33\r\n"});
}

TEST_CASE("a finished capture reads back as it was written, bit for bit", "[io][capture]") {
  const ScratchFolder folder;
  const auto path = folder / "run.viscap";
  {
    CaptureWriter writer(path, demo_run());
    write_one_of_each(writer);
    writer.finish("finished");
  }
  CHECK_FALSE(std::filesystem::exists(path.string() + "-wal"));  // one file that can be copied
  CHECK_FALSE(std::filesystem::exists(path.string() + "-shm"));
  CHECK(looks_like_capture(path));
  const CapturedRun run = read_capture(path);
  CHECK(run.status == "finished");
  CHECK(run.command == "viscard capture --emulate");
  CHECK(run.program == program_with_version());
  CHECK(run.started_at.size() == 20);  // 2026-11-21T09:14:15Z
  CHECK(toml_from_rig(run.rig) == toml_from_rig(demo_run().rig));
  CHECK(toml_from_test(run.plan) == toml_from_test(demo_run().plan));
  CHECK(toml_from_specimen(run.specimen) == toml_from_specimen(demo_run().specimen));
  REQUIRE(run.load_samples.size() == 3);
  CHECK(run.load_samples[0].counts == 1000.0);
  CHECK(run.load_samples[0].device_time_s == 0.1);
  CHECK_FALSE(run.load_samples[0].volts.has_value());
  CHECK(run.load_samples[1].host_time_s == 1.0 / 3.0);
  CHECK_FALSE(run.load_samples[1].device_time_s.has_value());
  CHECK_FALSE(run.load_samples[1].counts.has_value());
  CHECK(run.load_samples[1].volts == -0.1);
  CHECK(run.load_samples[1].is_saturated);
  CHECK(run.load_samples[1].is_glitch);
  CHECK(run.load_samples[2].force_N == 1.0 / 7.0);
  CHECK_FALSE(run.load_samples[1].force_N.has_value());
  REQUIRE(run.temperatures.size() == 1);
  CHECK(run.temperatures[0].host_time_s == 0.4);
  CHECK(run.temperatures[0].temperature_C == 23.0 + 1.0 / 3.0);
  REQUIRE(run.stage_reports.size() == 1);
  CHECK(run.stage_reports[0].position_m == 1e-3 / 7.0);
  CHECK(run.stage_reports[0].state == "Jog");
  REQUIRE(run.moves.size() == 1);
  CHECK(run.moves[0].purpose == "ramp");
  CHECK(run.moves[0].move.speed_m_s == 1.3e-4);
  CHECK(run.moves[0].start_uncertainty_s == 0.02);
  REQUIRE(run.events.size() == 1);
  CHECK(run.events[0].text == "the punch goes down");
  CHECK(run.n_raw_bytes == 16 + 9);
  std::vector<RawBytes> raw;
  read_raw_bytes(path, [&](const RawBytes& bytes) { raw.push_back(bytes); });
  REQUIRE(raw.size() == 3);
  CHECK(raw[2].device == Device::kThermometer);
  CHECK(raw[0].bytes == std::string("?\0\xff\n", 4));
  CHECK(raw[0].is_sent);
  CHECK(raw[1].device == Device::kLoadCell);
}

TEST_CASE("what became known later is added to a finished capture, which then is still sound",
          "[io][capture]") {
  const ScratchFolder folder;
  const auto path = folder / "run.viscap";
  {
    CaptureWriter writer(path, demo_run());
    write_one_of_each(writer);
    writer.append(RunEvent{12.5, "finished", "", "The run is complete"});
    CHECK(contains(error_text([&] { add_late_event(path, "doubt", "lost_steps", "26 um"); }),
                   "is being written"));
    writer.finish("finished");
  }
  add_late_event(path, "doubt", "lost_steps", "26 um");
  add_late_event(path, "depth", "counted", "not measured");
  const CapturedRun run = read_capture(path);
  CHECK(run.status == "finished");
  REQUIRE(run.events.size() == 4);
  CHECK(run.events[2].host_time_s == 12.5);  // at the end of the run
  CHECK(run.events[2].name == "doubt");
  CHECK(run.events[2].value == "lost_steps");
  CHECK(run.events[2].text == "26 um");
  CHECK(run.events[3].name == "depth");
  CHECK(check_capture(path).faults.empty());
  CHECK(run.load_samples.size() == 3);
  CHECK_FALSE(std::filesystem::exists(path.string() + "-journal"));
}

TEST_CASE("a capture being written reads as running, and afterwards as interrupted unless finished",
          "[io][capture]") {
  const ScratchFolder folder;
  const auto path = folder / "run.viscap";
  {
    CaptureWriter writer(path, demo_run());
    for (int i = 0; i < 100; ++i) writer.append(sample(i));
    writer.sync();
    const CapturedRun run = read_capture(path);
    CHECK(run.status == "running");
    CHECK(run.load_samples.size() == 100);
    CHECK(writer.counts().synced == 100);
    writer.append(sample(100));
  }
  const CapturedRun run = read_capture(path);
  CHECK(run.status == "interrupted");
  CHECK(run.load_samples.size() == 101);  // the destructor loses nothing
}

TEST_CASE("records are committed within the interval without a call of sync", "[io][capture]") {
  const ScratchFolder folder;
  CaptureWriter writer(folder / "run.viscap", demo_run());
  writer.append(sample(0));
  // Waits for the commit and not for a time; the timeout of the test ends it if it never comes.
  while (writer.counts().committed == 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  CHECK(writer.counts().committed == 1);
  while (writer.counts().synced == 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  CHECK(writer.counts().synced == 1);
}

TEST_CASE("nothing is overwritten unless asked for, and a live capture never", "[io][capture]") {
  const ScratchFolder folder;
  const auto path = folder / "run.viscap";
  {
    CaptureWriter writer(path, demo_run());
    writer.append(sample(0));
    CHECK(contains(error_text([&] { CaptureWriter second(path, demo_run(), {.overwrite = true}); }),
                   "is being written by another capture"));
    writer.finish("finished");
  }
  CHECK(contains(error_text([&] { CaptureWriter second(path, demo_run()); }),
                 "exists already; pass --force"));
  CHECK(read_capture(path).load_samples.size() == 1);
  CaptureWriter(path, demo_run(), {.overwrite = true}).finish("finished");
  CHECK(read_capture(path).load_samples.empty());
}

TEST_CASE("a capture is written only into a new plain file in an existing folder",
          "[io][capture]") {
  const ScratchFolder folder;
  CHECK(contains(error_text([&] { CaptureWriter w(folder / "no/run.viscap", demo_run()); }),
                 "create it first"));
  CHECK(contains(error_text([&] { CaptureWriter w(folder.path(), demo_run()); }),
                 "is not a plain file"));
  CHECK(contains(error_text([&] { CaptureWriter w("/dev/null", demo_run(), {.overwrite = true}); }),
                 "is not a plain file"));
  CHECK(contains(error_text([&] {
                   CaptureWriter w(folder / "run.viscap", demo_run(),
                                   {.min_free_bytes = std::size_t{1} << 60});
                 }),
                 "Make room first"));
  write_file(folder / "run.viscap-wal", "left over", false);
  CHECK(contains(error_text([&] { CaptureWriter w(folder / "run.viscap", demo_run()); }),
                 "belongs to an earlier capture"));
}

TEST_CASE("a full queue drops records, counts them and records where, but never drops an event",
          "[io][capture]") {
  const ScratchFolder folder;
  const auto path = folder / "run.viscap";
  std::size_t dropped = 0;
  {
    // The writer sleeps for the whole test, so the queue of ten must overflow.
    CaptureWriter writer(path, demo_run(), {.commit_interval_s = 1000.0, .queue_capacity = 10});
    for (int i = 0; i < 25; ++i) writer.append(sample(i));
    writer.append(RunEvent{1.0, "phase", "hold", ""});
    writer.sync();
    dropped = writer.counts().dropped;
    writer.finish("finished");
  }
  CHECK(dropped == 15);
  const CapturedRun run = read_capture(path);
  CHECK(run.load_samples.size() == 10);
  REQUIRE(run.events.size() == 2);
  CHECK(run.events[0].value == "hold");
  CHECK(run.events[1].name == "gap");
  CHECK(run.events[1].value == "15");
  CHECK(contains(run.events[1].text, "between 0.125 s and 0.3"));
}

TEST_CASE("records from several threads are all kept", "[io][capture]") {
  const ScratchFolder folder;
  const auto path = folder / "run.viscap";
  {
    CaptureWriter writer(path, demo_run());
    std::vector<std::thread> threads;
    for (int thread = 0; thread < 4; ++thread) {
      threads.emplace_back([&writer, thread] {
        for (int i = 0; i < 1000; ++i) writer.append(sample(1000 * thread + i));
      });
    }
    for (std::thread& thread : threads) thread.join();
    writer.finish("finished");
  }
  std::vector<int> seen(4000, 0);
  for (const LoadSample& one : read_capture(path).load_samples) {
    ++seen[static_cast<std::size_t>(one.index)];
  }
  CHECK(seen == std::vector<int>(4000, 1));
}

// A finished capture of `n` samples, as bytes.
std::string finished_bytes(const ScratchFolder& folder, int n) {
  const auto path = folder / "source.viscap";
  CaptureWriter writer(path, demo_run(), {.overwrite = true});
  for (int i = 0; i < n; ++i) writer.append(sample(i));
  writer.finish("finished");
  return read_file(path);
}

TEST_CASE("a file that is no whole capture is refused with one clear line", "[io][capture]") {
  const ScratchFolder folder;
  const auto path = folder / "run.viscap";
  const std::string whole = finished_bytes(folder, 2000);
  const auto error_with = [&](const std::string& bytes) {
    write_file(path, bytes, true);
    return error_text([&] { read_capture(path); });
  };
  CHECK(error_with(whole) == "");
  CHECK(contains(error_text([&] { read_capture(folder / "missing"); }),
                 "cannot open: No such file or directory"));
  CHECK(contains(error_text([&] { read_capture(folder.path()); }), "is a folder"));
  CHECK(contains(error_with(""), "is empty"));
  CHECK(contains(error_with("time_s,force_N\n0,1\n"), "not a capture"));
  CHECK(contains(error_with(whole.substr(0, 50)), "is truncated"));
  CHECK(contains(error_with(whole.substr(0, whole.size() / 2)), "is truncated: "));
  CHECK(contains(error_with(whole.substr(0, whole.size() - 1)), "is truncated: "));
  std::string foreign = whole;
  foreign[68] = 'X';
  CHECK(contains(error_with(foreign), "database of another program"));
  std::string newer = whole;
  newer[63] = 9;
  CHECK(contains(error_with(newer), "newer viscard (schema 9"));
  std::string damaged = whole;
  for (std::size_t i = 8192; i < 8192 + 64; ++i) damaged[i] = 'Z';
  CHECK(contains(error_with(damaged), "is damaged"));
  std::string empty_database = whole.substr(0, 100);
  CHECK(error_with(empty_database).size() > 10);
}

TEST_CASE("reading an interrupted capture changes neither the file nor its journal",
          "[io][capture]") {
  const ScratchFolder folder;
  const auto live = folder / "live.viscap";
  const auto path = folder / "copy.viscap";
  {
    CaptureWriter writer(live, demo_run());
    for (int i = 0; i < 500; ++i) writer.append(sample(i));
    writer.sync();
    // The files that a kill -9 would leave now.
    std::filesystem::copy_file(live, path);
    std::filesystem::copy_file(live.string() + "-wal", path.string() + "-wal");
  }
  const std::string main_before = read_file(path);
  const std::string journal_before = read_file(path.string() + "-wal");
  const CapturedRun run = read_capture(path);
  CHECK(run.status == "interrupted");
  CHECK(run.load_samples.size() == 500);
  CHECK(read_file(path) == main_before);
  CHECK(read_file(path.string() + "-wal") == journal_before);
  CHECK(read_capture(path).load_samples.size() == 500);

  // Only the main file was copied: its contents are read, and an event reports the missing part.
  const auto alone = folder / "alone.viscap";
  std::filesystem::copy_file(path, alone);
  const CapturedRun part = read_capture(alone);
  CHECK(part.status == "interrupted");
  REQUIRE(part.events.size() == 1);
  CHECK(part.events[0].name == "gap");
  CHECK(contains(part.events[0].text, "-wal is missing"));
}

}  // namespace
}  // namespace viscard
