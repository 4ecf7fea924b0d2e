#include "io/basics/atomic_file.h"
#include "io/capture/capture_file.h"
#include "io/capture/sqlite_database.h"
#include "io/tables/column_map.h"
#include "tests/io/capture/capture_samples.h"
#include "tests/support/error_text.h"
#include "tests/support/run_command.h"
#include "tests/support/scratch_folder.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

namespace viscard {
namespace {

using test::contains;
using test::run_command;
using test::ScratchFolder;

std::string capture_of(const ScratchFolder& folder, const std::string& status) {
  std::string path = folder / (status + ".viscap");
  CaptureWriter writer(path, test::demo_run());
  writer.append(RunEvent{0.0, "phase", "hold", ""});
  for (int i = 0; i < 50; ++i) writer.append(test::sample(i));
  if (status == "finished") writer.finish(status);
  return path;
}

TEST_CASE("viscard export writes every sample to stdout or to a file", "[cli][capture]") {
  const ScratchFolder folder;
  const std::string capture = capture_of(folder, "finished");
  const auto table = run_command({"export", capture});
  CHECK(table.status == kDone);
  CHECK(table.err.empty());
  CHECK(column_SI(csv_from_text(table.out, "stdout"), "time_s").size() == 50);
  const std::string out = folder / "run.csv";
  const auto file = run_command({"export", capture, "--out", out});
  CHECK(file.status == kDone);
  CHECK(file.err.empty());  // success goes to stdout in every command
  CHECK(read_file(out) == table.out);
  const auto again = run_command({"export", capture, "--out", out});
  CHECK(again.status == kFailed);
  CHECK(contains(again.err, "exists already; pass --force"));
  CHECK(run_command({"export", capture, "--out", out, "--force", "--raw"}).status == kDone);
  CHECK(contains(read_file(out), "host_time_s,device,direction,bytes"));
}

TEST_CASE("viscard export --json prints one object and nothing else", "[cli][capture]") {
  const ScratchFolder folder;
  const auto outcome = run_command({"export", capture_of(folder, "finished"), "--json"});
  const auto json = nlohmann::json::parse(outcome.out);
  CHECK(json["status"] == "finished");
  CHECK(json["n_samples"] == 50);
  CHECK(json["n_gaps"] == 0);
  CHECK(outcome.err.empty());
}

TEST_CASE("an interrupted capture is exported and marked as interrupted", "[cli][capture]") {
  const ScratchFolder folder;
  const auto outcome = run_command({"export", capture_of(folder, "interrupted")});
  CHECK(outcome.status == kDone);
  CHECK(contains(outcome.out, "# status: interrupted"));
  CHECK(contains(outcome.err, "is of an interrupted run; all that was committed is exported"));
  CHECK(column_SI(csv_from_text(outcome.out, "stdout"), "time_s").size() == 50);
}

TEST_CASE("viscard export --verify reports a capture that matches, and one with a flipped bit",
          "[cli][capture]") {
  const ScratchFolder folder;
  const std::string capture = capture_of(folder, "finished");
  const auto sound = run_command({"export", capture, "--verify"});
  CHECK(sound.status == kDone);
  CHECK(contains(sound.out, "51 records match "));
  CHECK(run_command({"export", capture, "--verify", "--raw"}).status == kBadWords);
  std::string bytes = read_file(capture);
  bytes[bytes.rfind("phasehold")] ^= 1;
  write_file(capture, bytes, true);
  const auto damaged = run_command({"export", capture, "--verify"});
  CHECK(damaged.status == kFailed);
  CHECK(contains(damaged.err, "table events, records 1 to "));
  CHECK(contains(damaged.err, "is damaged; use another copy"));
  const auto json =
      nlohmann::json::parse(run_command({"export", capture, "--verify", "--json"}).out);
  CHECK(json["is_checked"] == true);
  CHECK(json["faults"].size() == 1);
}

TEST_CASE("viscard export --verify names a side file that is missing", "[cli][capture]") {
  const ScratchFolder folder;
  const std::string live = folder / "live.viscap", copy = folder / "copy.viscap";
  CaptureWriter writer(live, test::demo_run());
  for (int i = 0; i < 50; ++i) writer.append(test::sample(i));
  writer.sync();
  std::filesystem::copy_file(live, copy);
  const auto verified = run_command({"export", copy, "--verify"});
  CHECK(verified.status == kFailed);
  CHECK(contains(verified.err, "its side file " + copy + "-wal"));
  const auto fitted = run_command({"fit", copy});
  CHECK(fitted.status == kFailed);
  CHECK(contains(fitted.err, copy + "-wal"));
}

TEST_CASE("viscard export --raw leaves altered bytes out and says so", "[cli][capture]") {
  const ScratchFolder folder;
  const std::string capture = folder / "run.viscap";
  {
    CaptureWriter writer(capture, test::demo_run());
    for (int i = 0; i < 50; ++i) {
      writer.append(RawBytes{Device::kLoadCell, false, 0.01 * i, std::to_string(1000 + i) + "\n"});
      writer.append(test::sample(i));
      if (i == 19) writer.sync();  // the checksum of the first 20
    }
    writer.finish("finished");
  }
  const auto sound = run_command({"export", capture, "--raw"});
  CHECK(sound.err.empty());
  CHECK(contains(sound.out, "1005\\n"));
  Database(capture, Database::Access::kReadWrite)
      .execute(
          "UPDATE raw_bytes SET bytes = CAST('7777' AS BLOB) WHERE bytes = CAST('1005' || "
          "char(10) AS BLOB)");
  const auto altered = run_command({"export", capture, "--raw"});
  CHECK(altered.status == kDone);
  CHECK(contains(altered.out, "# damage: "));
  CHECK(contains(altered.out, "raw messages of the capture were left out"));
  CHECK(contains(altered.err, "raw messages of the capture were left out"));
  CHECK_FALSE(contains(altered.out, "7777"));
  CHECK_FALSE(contains(altered.out, "1006"));
  CHECK(contains(altered.out, "1049\\n"));
  const auto samples =
      run_command({"export", capture});  // the readings have checksums of their own
  CHECK(samples.err.empty());
  CHECK_FALSE(contains(samples.out, "# damage: "));
}

TEST_CASE("viscard export refuses a file that is no capture in one line", "[cli][capture]") {
  const ScratchFolder folder;
  CHECK(run_command({"export"}).status == kBadWords);
  CHECK(run_command({"export", "a", "b"}).status == kBadWords);
  const auto missing = run_command({"export", folder / "none.viscap"});
  CHECK(missing.status == kFailed);
  CHECK(contains(missing.err, "No such file"));
  const std::string whole = read_file(capture_of(folder, "finished"));
  write_file(folder / "cut.viscap", whole.substr(0, whole.size() / 3), false);
  const auto truncated = run_command({"export", folder / "cut.viscap"});
  CHECK(truncated.status == kFailed);
  CHECK(truncated.out.empty());
  CHECK(contains(truncated.err, "is truncated"));
}

}  // namespace
}  // namespace viscard
