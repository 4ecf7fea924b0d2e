// What reading a capture makes of damage, of side files of other runs, and of a file that disappears.
#include "io/basics/atomic_file.h"
#include "io/capture/capture_check.h"
#include "io/capture/capture_export.h"
#include "io/capture/capture_file.h"
#include "io/capture/integrity_notes.h"
#include "io/capture/sqlite_database.h"
#include "io/config/config_file.h"
#include "tests/io/capture/capture_samples.h"
#include "tests/support/error_text.h"
#include "tests/support/scratch_folder.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <chrono>
#include <random>
#include <thread>

namespace viscard {
namespace {

using test::contains;
using test::demo_run;
using test::error_text;
using test::sample;
using test::ScratchFolder;

std::filesystem::path capture_of(const ScratchFolder& folder, const char* name, int n_samples) {
  auto path = folder / name;
  CaptureWriter writer(path, demo_run());
  for (int i = 0; i < n_samples; ++i) {
    writer.append(sample(i));
    if (i % 40 == 0) writer.append(RunEvent{0.0125 * i, "phase", "hold", ""});
    if (i % 40 == 0) writer.sync();  // a checksum for each 40
  }
  writer.append(StageReport{1.0, 1e-3, "Idle"});
  writer.append(CommandedMove{{0.25, 0.0, 1.5e-4, 1.3e-4, 0.2}, 0.02, "ramp"});
  writer.finish("finished");
  return path;
}

void change(const std::filesystem::path& path, const char* sql) {
  Database(path, Database::Access::kReadWrite).execute(sql);
}

std::string contents_of(const CapturedRun& run) {
  return csv_from_capture(run) + toml_from_rig(run.rig) + toml_from_test(run.plan) +
         toml_from_specimen(run.specimen);
}

bool has_note(const CapturedRun& run, const std::string& name) {
  const std::vector<IntegrityNote> notes = integrity_notes(run);
  return std::any_of(notes.begin(), notes.end(),
                     [&](const IntegrityNote& note) { return note.name == name; });
}

TEST_CASE(
    "a capture whose description, events or moves were changed is read only if that is accepted",
    "[io][capture]") {
  const ScratchFolder folder;
  const auto path = capture_of(folder, "run.viscap", 100);
  change(path,
         GENERATE("UPDATE run SET value = replace(value, '0.0044', '0.0064') WHERE key = "
                  "'specimen_toml'",
                  "UPDATE run SET value = value || ' ' WHERE key = 'rig_toml'",
                  "UPDATE run SET value = 'interrupted' WHERE key = 'status'",
                  "UPDATE events SET value = 'ramp' WHERE rowid = (SELECT min(rowid) FROM events)",
                  "DELETE FROM moves", "UPDATE moves SET speed_m_s = 2.6e-4"));
  const std::string error = error_text([&] { read_capture(path); });
  CAPTURE(error);
  CHECK(contains(error, "run.viscap is damaged"));
  CHECK(contains(error, "--unverified"));
  const CapturedRun run = read_capture(path, {.accepts_damage = true});
  CHECK(run.load_samples.size() == 100);
  CHECK(has_note(run, "unverified"));
  CHECK(contains(csv_from_capture(run), "read with --unverified"));
}

TEST_CASE("a capture without one of its tables is refused with its name", "[io][capture]") {
  const ScratchFolder folder;
  const auto path = capture_of(folder, "run.viscap", 100);
  const std::string table = GENERATE("run", "load_samples", "moves", "events");
  change(path, ("DROP TABLE " + table).c_str());
  const std::string error = error_text([&] { read_capture(path); });
  CAPTURE(error);
  CHECK(contains(error, "run.viscap: "));
  CHECK(contains(error, table));
  CHECK(contains(error, "altered"));
}

TEST_CASE("damaged readings are left out and counted, the others are read", "[io][capture]") {
  const ScratchFolder folder;
  const auto path = capture_of(folder, "run.viscap", 100);
  CHECK(integrity_notes(read_capture(path)).empty());
  change(
      path,
      GENERATE("UPDATE load_samples SET counts = counts + 1 WHERE sample_index = 50",
               "DELETE FROM load_samples WHERE sample_index = 50",
               "UPDATE checksums SET crc32 = crc32 + 1 WHERE table_name = 'load_samples' "
               "AND rowid = (SELECT max(rowid) FROM checksums WHERE table_name = 'load_samples')",
               "INSERT INTO load_samples(seq, sample_index, host_time_s, counts, is_saturated, "
               "is_glitch) VALUES (100000, 100, 1.3, 5e5, 0, 0)"));
  const CapturedRun run = read_capture(path);
  CHECK(run.load_samples.size() >= 40);
  CHECK(run.load_samples.size() <= 100);
  CHECK(run.integrity.n_left_out_samples > 0);
  CHECK(has_note(run, "samples-damaged"));
  for (const LoadSample& one : run.load_samples) {
    CHECK(*one.counts == 1000.0 + static_cast<double>(one.index));
  }
}

TEST_CASE("no flipped bit changes what a reader gets without a word", "[io][capture]") {
  const ScratchFolder folder;
  const auto path = capture_of(folder, "run.viscap", 200);
  const std::string whole = read_file(path), contents = contents_of(read_capture(path));
  std::mt19937 random(11);
  std::uniform_int_distribution<std::size_t> bit(0, 8 * whole.size() - 1);
  const auto damaged = folder / "damaged.viscap";
  int n_refused = 0, n_noted = 0, n_same = 0;
  for (int flip = 0; flip < 300; ++flip) {
    std::string bytes = whole;
    const std::size_t at = bit(random);
    bytes[at / 8] = static_cast<char>(bytes[at / 8] ^ (1 << (at % 8)));
    write_file(damaged, bytes, true);
    CapturedRun run;
    if (!error_text([&] { run = read_capture(damaged); }).empty()) {
      ++n_refused;
      continue;
    }
    const bool is_noted = !run.integrity.faults.empty(), is_same = contents_of(run) == contents;
    ++(is_same ? n_same : n_noted);
    INFO("bit " << at);
    CHECK((is_noted || is_same));
  }
  CHECK(n_refused > 20);
  CHECK(n_noted > 20);
}

TEST_CASE("a capture of before there were checksums is read and called unchecked",
          "[io][capture]") {
  const ScratchFolder folder;
  const auto path = capture_of(folder, "run.viscap", 100);
  change(path, "DROP TABLE checksums; DROP TABLE temperatures; PRAGMA user_version=2");
  const CapturedRun run = read_capture(path);
  CHECK(run.load_samples.size() == 100);
  CHECK(has_note(run, "unchecked"));
}

TEST_CASE("values that no instrument gives are refused with their place", "[io][capture]") {
  struct Case {
    const char* sql;
    const char* what;
  };
  const auto c = GENERATE(
      Case{"UPDATE load_samples SET counts = 1e160 WHERE sample_index = 7",
           "reading 8 has a number of counts"},
      Case{"UPDATE load_samples SET volts = -9e999 WHERE sample_index = 7",
           "reading 8 has a voltage"},
      Case{"UPDATE load_samples SET host_time_s = 1e30 WHERE sample_index = 7",
           "reading 8 has a time"},
      Case{"UPDATE moves SET speed_m_s = 0", "move 1 has a speed"},
      Case{"UPDATE moves SET acceleration_m_s2 = -1", "move 1 has a acceleration"},
      Case{"UPDATE stage_reports SET position_m = 1e4", "report of the stage 1 has a position"});
  const ScratchFolder folder;
  const auto path = capture_of(folder, "run.viscap", 20);
  change(path, "DROP TABLE checksums; DROP TABLE temperatures; PRAGMA user_version=2");
  change(path, c.sql);
  const std::string error = error_text([&] { read_capture(path); });
  CAPTURE(error);
  CHECK(contains(error, c.what));
}

TEST_CASE("a capture with a view in the place of a table is refused, even one without end",
          "[io][capture]") {
  const ScratchFolder folder;
  const auto path = capture_of(folder, "run.viscap", 20);
  change(
      path,
      "ALTER TABLE load_samples RENAME TO samples; CREATE VIEW load_samples AS WITH RECURSIVE "
      "n(seq) AS (SELECT 1 UNION ALL SELECT seq + 1 FROM n) SELECT seq, seq AS sample_index, 0.0 "
      "AS "
      "host_time_s, NULL AS device_time_s, 1.0 AS counts, NULL AS volts, 0 AS is_saturated, 0 AS "
      "is_glitch, NULL AS force_N FROM n");
  CHECK(contains(error_text([&] { read_capture(path); }), "holds the view load_samples"));
  CHECK(contains(error_text([&] { check_capture(path); }), "holds the view load_samples"));
}

TEST_CASE("a capture whose columns or indexes are computed is refused before they are",
          "[io][capture]") {
  const ScratchFolder folder;
  const auto path = capture_of(folder, "run.viscap", 20);
  SECTION("a column") {
    change(path, "ALTER TABLE moves ADD COLUMN x GENERATED ALWAYS AS (hex(zeroblob(200000000)))");
    CHECK(contains(error_text([&] { read_capture(path); }), "holds the column moves.x"));
    CHECK(contains(error_text([&] { check_capture(path); }), "holds the column moves.x"));
  }
  SECTION("an index") {
    change(path, "CREATE INDEX long ON moves(hex(zeroblob(seq)))");
    CHECK(contains(error_text([&] { read_capture(path); }), "holds the index long"));
  }
}

// The files of a run that is not finished, as kill -9 leaves them.
void copy_as_killed(const std::filesystem::path& from, const std::filesystem::path& to) {
  for (const char* part : {"", "-wal"}) {
    std::filesystem::copy_file(from.string() + part, to.string() + part);
  }
}

TEST_CASE("the side file of another run is not read as this one's", "[io][capture]") {
  const ScratchFolder folder;
  const auto live = folder / "live.viscap", killed = folder / "killed.viscap",
             other = folder / "other.viscap", second = folder / "second.viscap";
  {
    CaptureWriter writer(live, demo_run());
    for (int i = 0; i < 60; ++i) writer.append(sample(i));
    writer.sync();
    copy_as_killed(live, killed);
  }
  REQUIRE(read_capture(killed).load_samples.size() == 60);
  const auto finished = capture_of(folder, "finished.viscap", 100);
  std::filesystem::copy_file(finished, killed, std::filesystem::copy_options::overwrite_existing);
  const std::string error = error_text([&] { read_capture(killed); });
  CHECK(contains(error, "belongs to another run"));
  CHECK_FALSE(error_text([&] { read_capture_state(killed); }).empty());
  std::filesystem::remove(killed.string() + "-wal");
  CHECK(read_capture(killed).load_samples.size() == 100);

  // Both runs were killed, so that both files expect a log.
  {
    CaptureWriter writer(second, demo_run());
    for (int i = 0; i < 30; ++i) writer.append(sample(i));
    writer.sync();
    copy_as_killed(second, other);
  }
  CHECK(read_capture(other).load_samples.size() == 30);
  {
    CaptureWriter writer(folder / "third.viscap", demo_run());
    writer.append(sample(0));
    writer.sync();
    std::filesystem::copy_file(folder / "third.viscap", other,
                               std::filesystem::copy_options::overwrite_existing);
  }
  CHECK(contains(error_text([&] { read_capture(other); }), "belongs to another run"));
}

TEST_CASE("an interrupted capture without its side file says that it may be incomplete",
          "[io][capture]") {
  const ScratchFolder folder;
  const auto live = folder / "live.viscap", copy = folder / "copy.viscap";
  CaptureWriter writer(live, demo_run());
  writer.append(sample(0));
  writer.sync();
  std::filesystem::copy_file(live, copy);
  const CapturedRun run = read_capture(copy);
  CHECK(run.integrity.has_lost_log);
  CHECK(has_note(run, "side-file-missing"));
  const CaptureCheck check = check_capture(copy);
  REQUIRE(check.faults.size() == 1);
  CHECK(contains(check.faults.front(), copy.string() + "-wal"));
  CHECK(contains(check.faults.front(), "is missing"));
}

TEST_CASE("one damaged temperature \"was\" left out", "[io][capture]") {
  CapturedRun run = demo_run();
  run.integrity.n_left_out_temperatures = 1;
  CHECK(contains(integrity_notes(run).front().text, "1 temperature of the capture was left out"));
  run.integrity.n_left_out_temperatures = 2;
  CHECK(contains(integrity_notes(run).front().text, "2 temperatures of the capture were left out"));
}

// The first error of append() after something was done to the file.
template <typename Change>
std::string error_after(const std::filesystem::path& path, const Change& change_file) {
  CaptureWriter writer(path, demo_run());
  writer.append(sample(0));
  writer.sync();
  change_file();
  for (int i = 1; i < 1000; ++i) {
    const std::string error = error_text([&] { writer.append(sample(i)); });
    if (!error.empty()) return error;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return {};
}

TEST_CASE("a capture that is deleted, moved or replaced during its run is noticed",
          "[io][capture]") {
  const ScratchFolder folder;
  const auto path = folder / "run.viscap", away = folder / "away.viscap";
  CHECK(contains(error_after(path, [&] { std::filesystem::remove(path); }),
                 "run.viscap was deleted while the run was writing it"));
  for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
    std::filesystem::remove(entry.path());
  }
  const std::string moved = error_after(path, [&] { std::filesystem::rename(path, away); });
  CHECK(contains(moved, "was moved to " + away.string()));
}

TEST_CASE("a capture of which only a hard link is left is not said to lie under its old name",
          "[io][capture]") {
  const ScratchFolder folder;
  const auto path = folder / "run.viscap", link = folder / "link.viscap";
  const std::string error = error_after(path, [&] {
    std::filesystem::create_hard_link(path, link);
    std::filesystem::remove(path);
  });
  CAPTURE(error);
  CHECK(contains(error, "run.viscap was moved: "));
  CHECK(contains(error, "hard link"));
  CHECK_FALSE(contains(error, "(deleted)"));
}

}  // namespace
}  // namespace viscard
