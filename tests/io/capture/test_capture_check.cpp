// Flipped bits in a capture, as a worn disk or a bad copy makes them.
#include "io/basics/atomic_file.h"
#include "io/capture/capture_check.h"
#include "io/capture/capture_export.h"
#include "io/capture/capture_file.h"
#include "io/capture/row_checksum.h"
#include "io/capture/sqlite_database.h"
#include "tests/io/capture/capture_samples.h"
#include "tests/support/error_text.h"
#include "tests/support/scratch_folder.h"

#include <catch2/catch.hpp>

#include <random>

namespace viscard {
namespace {

using test::contains;
using test::demo_run;
using test::error_text;
using test::sample;
using test::ScratchFolder;

std::filesystem::path finished_capture(const ScratchFolder& folder) {
  auto path = folder / "run.viscap";
  CaptureWriter writer(path, demo_run());
  for (int i = 0; i < 200; ++i) {
    writer.append(
        RawBytes{Device::kLoadCell, false, 0.0125 * i, std::to_string(12000 + i) + "\r\n"});
    writer.append(sample(i));
    if (i % 50 == 0) writer.append(RunEvent{0.0125 * i, "phase", "hold", ""});
  }
  writer.append(StageReport{1.0, 1e-3, "Idle"});
  writer.append(CommandedMove{{0.25, 0.0, 1.5e-4, 1.3e-4, 0.2}, 0.02, "ramp"});
  writer.finish("finished");
  return path;
}

// All that a user gets out of a capture.
std::string contents_of(const std::filesystem::path& path) {
  const CapturedRun run = read_capture(path);
  return csv_from_capture(run) + csv_from_raw_bytes(path, run) + toml_from_rig(run.rig) +
         toml_from_test(run.plan) + toml_from_specimen(run.specimen);
}

TEST_CASE("the checksum of rows is CRC-32", "[io][capture]") {
  RowChecksum checksum;
  checksum.add("123456789");
  CHECK(checksum.crc32() == 0xcbf43926);  // the check value of the standard
}

TEST_CASE("a capture that was not changed matches its checksums", "[io][capture]") {
  const ScratchFolder folder;
  const CaptureCheck check = check_capture(finished_capture(folder));
  CHECK(check.is_checked);
  CHECK(check.n_records == 406);
  CHECK(check.n_batches >= 5);
  CHECK(check.faults.empty());
}

TEST_CASE("an interrupted or running capture matches its checksums too", "[io][capture]") {
  const ScratchFolder folder;
  const auto path = folder / "run.viscap";
  CaptureWriter writer(path, demo_run());
  for (int i = 0; i < 100; ++i) writer.append(sample(i));
  writer.sync();
  const CaptureCheck check = check_capture(path);
  CHECK(check.n_records == 100);
  CHECK(check.faults.empty());
}

TEST_CASE("no flipped bit changes what is read from a capture unnoticed", "[io][capture]") {
  const ScratchFolder folder;
  const auto path = finished_capture(folder);
  const std::string whole = read_file(path);
  const std::string contents = contents_of(path);
  std::mt19937 random(5);
  std::uniform_int_distribution<std::size_t> bit(0, 8 * whole.size() - 1);
  const auto damaged = folder / "damaged.viscap";
  int n_noticed = 0, n_harmless = 0, n_silent = 0;
  for (int flip = 0; flip < 400; ++flip) {
    std::string bytes = whole;
    const std::size_t at = bit(random);
    bytes[at / 8] = static_cast<char>(bytes[at / 8] ^ (1 << (at % 8)));
    write_file(damaged, bytes, true);
    bool is_noticed = false;
    const std::string error =
        error_text([&] { is_noticed = !check_capture(damaged).faults.empty(); });
    if (is_noticed || !error.empty()) {
      ++n_noticed;
      continue;
    }
    std::string now;
    const std::string reading = error_text([&] { now = contents_of(damaged); });
    const bool is_same = reading.empty() && now == contents;  // the bit is in unused space
    ++(is_same ? n_harmless : n_silent);
    INFO("bit " << at << " " << reading);
    CHECK(is_same);
  }
  CHECK(n_silent == 0);
  CHECK(n_noticed > 100);
}

TEST_CASE("a flipped bit of the raw bytes is reported with its table and records",
          "[io][capture]") {
  const ScratchFolder folder;
  const auto path = finished_capture(folder);
  std::string bytes = read_file(path);
  const std::size_t at = bytes.find("12100\r\n");
  REQUIRE(at != std::string::npos);
  bytes[at] = static_cast<char>(bytes[at] ^ 1);
  write_file(path, bytes, true);
  const CaptureCheck check = check_capture(path);
  REQUIRE(check.faults.size() == 1);
  CHECK(contains(check.faults[0], "table raw_bytes, records "));
  CHECK(contains(check.faults[0], "not what was written"));
}

TEST_CASE("a capture of an earlier schema opens and is unchecked", "[io][capture]") {
  const ScratchFolder folder;
  const auto path = finished_capture(folder);
  const std::string contents = contents_of(path);
  Database(path, Database::Access::kReadWrite)
      .execute("DROP TABLE checksums; PRAGMA user_version=2");
  const CaptureCheck check = check_capture(path);
  CHECK_FALSE(check.is_checked);
  CHECK(check.faults.empty());
  CHECK(contents_of(path) == contents);
}

TEST_CASE("a capture from before thermometers opens, and its checksums are compared",
          "[io][capture]") {
  const ScratchFolder folder;
  const auto path = finished_capture(folder);
  Database(path, Database::Access::kReadWrite)
      .execute("DROP TABLE temperatures; PRAGMA user_version=3");
  const CapturedRun run = read_capture(path);
  CHECK(run.load_samples.size() > 10);
  CHECK(run.temperatures.empty());
  const CaptureCheck check = check_capture(path);
  CHECK(check.is_checked);
  CHECK(check.faults.empty());
}

TEST_CASE("a changed temperature is reported", "[io][capture]") {
  const ScratchFolder folder;
  const auto path = folder / "warm.viscap";
  {
    CaptureWriter writer(path, test::demo_run());
    writer.append(TemperatureSample{0.4, 23.5});
    writer.finish("finished");
  }
  CHECK(check_capture(path).faults.empty());
  Database(path, Database::Access::kReadWrite)
      .execute("UPDATE temperatures SET temperature_C = 24.5");
  const CaptureCheck check = check_capture(path);
  REQUIRE(check.faults.size() == 1);
  CHECK(contains(check.faults[0], "table temperatures"));
}

}  // namespace
}  // namespace viscard
