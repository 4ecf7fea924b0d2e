// What reading a capture makes of its write-ahead log: bits that flipped, holes, torn ends.
#include "io/basics/atomic_file.h"
#include "io/capture/capture_check.h"
#include "io/capture/capture_file.h"
#include "io/capture/capture_lock.h"
#include "io/capture/integrity_notes.h"
#include "tests/io/capture/capture_samples.h"
#include "tests/support/error_text.h"
#include "tests/support/scratch_folder.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <random>
#include <thread>

namespace viscard {
namespace {

using test::contains;
using test::demo_run;
using test::error_text;
using test::sample;
using test::ScratchFolder;

constexpr std::size_t kHeader_B = 32, kFrame_B = 24 + 4096;

// A capture as kill -9 leaves it: the file and its log.
struct KilledCapture {
  std::filesystem::path file;
  std::string log_name() const { return file.string() + "-wal"; }
  std::string log() const { return read_file(log_name()); }
  // Not by write_file(), which refuses the name of a log.
  void put_log(const std::string& bytes) const {
    std::ofstream(log_name(), std::ios::binary) << bytes;
  }
  void flip(std::size_t at) const {
    std::string bytes = log();
    bytes.at(at) = static_cast<char>(bytes.at(at) ^ 0x10);
    put_log(bytes);
  }
};

KilledCapture copy_of_live(const ScratchFolder& folder, const std::filesystem::path& live) {
  KilledCapture killed{folder / "killed.viscap"};
  std::filesystem::copy_file(live, killed.file);
  std::filesystem::copy_file(live.string() + "-wal", killed.log_name());
  return killed;
}

// 400 readings, of which each 40 were synced together.
KilledCapture killed_capture(const ScratchFolder& folder) {
  const auto live = folder / "live.viscap";
  CaptureWriter writer(live, demo_run());
  for (int i = 0; i < 400; ++i) {
    writer.append(sample(i));
    if (i % 40 == 39) writer.sync();
  }
  return copy_of_live(folder, live);
}

bool is_flagged(const CapturedRun& run, const std::string& name) {
  const std::vector<IntegrityNote> notes = integrity_notes(run);
  return std::any_of(notes.begin(), notes.end(),
                     [&](const IntegrityNote& note) { return note.name == name; });
}

// Refused with the name of the log and the way to go on; read only if that is accepted, and flagged.
void check_is_refused(const KilledCapture& killed) {
  const std::string error = error_text([&] { read_capture(killed.file); });
  CAPTURE(error);
  CHECK(contains(error, "killed.viscap is damaged"));
  CHECK(contains(error, "killed.viscap-wal"));
  CHECK(contains(error, "--unverified"));
  const CapturedRun run = read_capture(killed.file, {.accepts_damage = true});
  CHECK(run.load_samples.size() < 400);
  CHECK(is_flagged(run, "unverified"));
  const CaptureCheck check = check_capture(killed.file);
  REQUIRE_FALSE(check.faults.empty());
  CHECK(contains(check.faults.front(), "side file"));
}

TEST_CASE("a killed capture is read whole from its side file", "[io][capture]") {
  const ScratchFolder folder;
  const KilledCapture killed = killed_capture(folder);
  const CapturedRun run = read_capture(killed.file);
  CHECK(run.load_samples.size() == 400);
  CHECK(integrity_notes(run).empty());
  CHECK(check_capture(killed.file).faults.empty());
}

TEST_CASE("a flipped bit in the header or a frame of the side file is damage", "[io][capture]") {
  const ScratchFolder folder;
  const KilledCapture killed = killed_capture(folder);
  // Magic, size of pages, salts, checksum; number, salts, checksum and page of frame 1; frame 3.
  killed.flip(GENERATE(3u, 10u, 20u, 28u, 34u, 41u, 50u, 100u, kHeader_B + 2 * kFrame_B + 1000));
  check_is_refused(killed);
}

TEST_CASE("a side file that is garbage, or holds a hole, is damage", "[io][capture]") {
  const ScratchFolder folder;
  const KilledCapture killed = killed_capture(folder);
  std::string log = killed.log();
  SECTION("garbage") {
    std::mt19937 random(3);
    log.resize(5000);
    std::generate(log.begin(), log.end(), [&] { return static_cast<char>(random()); });
  }
  SECTION("text") {
    log = "not a log\n";
  }
  SECTION("zeros in the place of frame 2") {
    log.replace(kHeader_B + kFrame_B, kFrame_B, kFrame_B, '\0');
  }
  SECTION("a byte is missing in frame 2") {
    log.erase(kHeader_B + kFrame_B + 500, 1);
  }
  killed.put_log(log);
  check_is_refused(killed);
}

TEST_CASE("no flipped bit in a side file cuts the record without a word", "[io][capture]") {
  const ScratchFolder folder;
  const KilledCapture killed = killed_capture(folder);
  const std::string whole = killed.log();
  std::mt19937 random(7);
  std::uniform_int_distribution<std::size_t> place(0, whole.size() - kFrame_B - 1);
  int n_refused = 0;
  for (int flip = 0; flip < 60; ++flip) {
    killed.put_log(whole);
    const std::size_t at = place(random);
    killed.flip(at);
    INFO("byte " << at << " of " << whole.size());
    CapturedRun run;
    if (!error_text([&] { run = read_capture(killed.file); }).empty()) {
      ++n_refused;
      continue;
    }
    // In the last transaction, which no later one shows to be safe.
    CHECK(is_flagged(run, "side-file-torn"));
  }
  CHECK(n_refused > 40);
}

TEST_CASE("a last frame that was being written is no damage", "[io][capture]") {
  const ScratchFolder folder;
  const KilledCapture killed = killed_capture(folder);
  std::string log = killed.log();
  SECTION("half of it") {
    log.resize(log.size() - 100);
  }
  SECTION("all of it, not yet what it should be") {
    log.back() = static_cast<char>(log.back() ^ 1);
  }
  killed.put_log(log);
  const CapturedRun run = read_capture(killed.file);
  CHECK(run.load_samples.size() >= 360);
  CHECK(run.load_samples.size() < 400);
  CHECK(integrity_notes(run).empty());
  CHECK(check_capture(killed.file).faults.empty());
}

TEST_CASE("frames of an earlier use of the side file are no damage", "[io][capture]") {
  const ScratchFolder folder;
  const auto live = folder / "live.viscap";
  CaptureWriter writer(live, demo_run());
  // Beyond the thousand pages after which SQLite merges the log and begins it anew.
  for (int i = 0; i < 1500; ++i) {
    writer.append(RawBytes{Device::kLoadCell, false, 0.001 * i, std::string(4000, 'x')});
    if (i % 100 == 99) writer.sync();
  }
  for (int i = 0; i < 50; ++i) writer.append(sample(i));
  writer.sync();
  const KilledCapture killed = copy_of_live(folder, live);
  const std::string log = killed.log();
  REQUIRE(log.substr(12, 4) != std::string(4, '\0'));  // it was begun anew
  const CapturedRun run = read_capture(killed.file);
  CHECK(run.load_samples.size() == 50);
  CHECK(integrity_notes(run).empty());
  killed.flip(log.size() - 100);
  CHECK(integrity_notes(read_capture(killed.file)).empty());
}

TEST_CASE("a hole among frames that were not synced is flagged, as a power cut leaves it",
          "[io][capture]") {
  const ScratchFolder folder;
  const auto live = folder / "live.viscap";
  CaptureWriter writer(live, demo_run(), {.commit_interval_s = 0.001, .sync_interval_s = 1000.0});
  for (int i = 0; i < 40; ++i) writer.append(sample(i));
  writer.sync();
  const auto synced_B =
      static_cast<std::size_t>(std::filesystem::file_size(live.string() + "-wal"));
  for (int i = 40; i < 45; ++i) {
    writer.append(sample(i));
    while (writer.counts().committed < writer.counts().appended) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }
  const KilledCapture killed = copy_of_live(folder, live);
  CHECK(read_capture(killed.file).load_samples.size() == 45);
  killed.put_log(killed.log().replace(synced_B, kFrame_B, kFrame_B, '\0'));
  const CapturedRun run = read_capture(killed.file);
  CHECK(run.load_samples.size() == 40);
  CHECK(is_flagged(run, "side-file-torn"));
  CHECK_FALSE(is_flagged(run, "unverified"));
  CHECK(check_capture(killed.file).faults.size() == 1);
}

// What --force does with a capture when the process that records the new one is killed, too: it stays aside.
void force_and_die(const std::filesystem::path& capture) {
  PreviousCapture previous(capture, true);
  REQUIRE(previous.is_aside());
  for (const char* part : {"", "-wal", "-shm"}) {
    const std::string kept = capture.string() + ".previous" + part;
    if (std::filesystem::exists(kept)) std::filesystem::rename(kept, kept + ".kept");
  }
  previous.drop();
  for (const char* part : {"", "-wal", "-shm"}) {
    const std::string kept = capture.string() + ".previous" + part;
    if (std::filesystem::exists(kept + ".kept")) std::filesystem::rename(kept + ".kept", kept);
  }
}

TEST_CASE("a killed capture that --force keeps is one file with all records", "[io][capture]") {
  const ScratchFolder folder;
  const KilledCapture killed = killed_capture(folder);
  force_and_die(killed.file);
  const std::string kept = killed.file.string() + ".previous";
  CHECK_FALSE(std::filesystem::exists(kept + "-wal"));
  CHECK_FALSE(std::filesystem::exists(kept + "-shm"));
  std::filesystem::rename(kept, folder / "old.viscap");
  const CapturedRun run = read_capture(folder / "old.viscap");
  CHECK(run.status == "interrupted");
  CHECK(run.load_samples.size() == 400);
  CHECK(integrity_notes(run).empty());
  CHECK(check_capture(folder / "old.viscap").faults.empty());
}

TEST_CASE("a capture whose log is damaged is kept in all its parts, which the refusal names",
          "[io][capture]") {
  const ScratchFolder folder;
  const KilledCapture killed = killed_capture(folder);
  killed.flip(kHeader_B + kFrame_B + 100);
  const std::string log = killed.log(), kept = killed.file.string() + ".previous";
  force_and_die(killed.file);
  REQUIRE(read_file(kept + "-wal") == log);
  write_file(killed.file, "", false);
  const std::string both = error_text([&] { PreviousCapture(killed.file, true); });
  CHECK(contains(both, kept + ", " + kept + "-wal"));
  CHECK(contains(both, "move them away together"));
  // Who moves the main file alone has not moved the records.
  std::filesystem::rename(kept, folder / "old.viscap");
  const std::string orphaned = error_text([&] { PreviousCapture(killed.file, true); });
  CHECK(contains(orphaned, kept + "-wal belongs to an earlier capture whose main file is gone"));
  CHECK(read_file(kept + "-wal") == log);
}

TEST_CASE("the option --force deletes no log of a capture that was moved away", "[io][capture]") {
  const ScratchFolder folder;
  const KilledCapture killed = killed_capture(folder);
  const std::string log = killed.log();
  std::filesystem::rename(killed.file, folder / "old.viscap");
  const auto forced = [&] {
    return error_text([&] {
      PreviousCapture previous(killed.file, true);
      CaptureWriter(killed.file, demo_run(), {.overwrite = true});
    });
  };
  SECTION("nothing in its place") {
    CHECK(contains(forced(), "killed.viscap-wal belongs to an earlier capture"));
  }
  SECTION("an empty file in its place") {
    write_file(killed.file, "", false);
    CHECK(contains(forced(), "killed.viscap-wal belongs to an earlier capture"));
  }
  SECTION("another capture in its place") {
    { CaptureWriter(folder / "other.viscap", demo_run()); }
    std::filesystem::rename(folder / "other.viscap", killed.file);
    CHECK(contains(forced(), "killed.viscap-wal belongs to another run"));
  }
  CHECK(killed.log() == log);
  std::filesystem::rename(folder / "old.viscap", killed.file);
  CHECK(read_capture(killed.file).load_samples.size() == 400);
}

TEST_CASE("a capture does not replace a link that leads to nothing", "[io][capture]") {
  const ScratchFolder folder;
  std::filesystem::create_directory(folder / "real");
  std::filesystem::create_symlink("real/run.viscap", folder / "link.viscap");
  for (const bool is_forced : {false, true}) {
    CHECK(contains(error_text([&] {
                     CaptureWriter(folder / "link.viscap", demo_run(), {.overwrite = is_forced});
                   }),
                   "leads to real/run.viscap, which does not exist; name the file itself"));
    CHECK(std::filesystem::is_symlink(folder / "link.viscap"));
  }
}

}  // namespace
}  // namespace viscard
