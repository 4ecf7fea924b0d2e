// The exported table of a capture, fitted as any other table, against the fit of the capture.
#include "fit/fit_indentation.h"
#include "fit/indentation_from_capture.h"
#include "fit/run_timing.h"
#include "io/basics/atomic_file.h"
#include "io/capture/capture_file.h"
#include "io/capture/sqlite_database.h"
#include "io/flow/damaged_table.h"
#include "io/flow/fit_file.h"
#include "io/flow/table_from_capture.h"
#include "tests/io/capture/capture_samples.h"
#include "tests/support/error_text.h"
#include "tests/support/in_memory_run.h"
#include "tests/support/run_command.h"
#include "tests/support/scratch_folder.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace viscard {
namespace {

using test::contains;
using test::ScratchFolder;

FitResult fit_of_table(const std::string& path, const Specimen& specimen) {
  FitRequest request;
  request.specimen = specimen;
  return fit_file(path, request).result;
}

// Distance of the capture's modulus from that of the table, in half-widths of the table's 95 %
// interval.
double half_widths_apart(const FitResult& table, const FitResult& capture) {
  const double half_Pa = 0.5 * (table.E0_interval_95.high - table.E0_interval_95.low);
  return std::abs(table.E0_Pa - capture.E0_Pa) / half_Pa;
}

void check_same_answer(const FitResult& table, const FitResult& capture) {
  INFO("E0 of the table " << table.E0_Pa << ", " << table.E0_interval_95.low << " to "
                          << table.E0_interval_95.high << "; of the capture " << capture.E0_Pa);
  CHECK(table.E0_Pa == Approx(capture.E0_Pa).epsilon(0.01));
  // The fit of a capture also follows the drift of the load cell, which no fit of a table does.
  CHECK(table.E_inf_Pa == Approx(capture.E_inf_Pa).epsilon(5e-4));
  for (const MaterialFlag& flag : table.flags) {
    CHECK(flag.name != "misfit");
    CHECK(flag.name != "gap-in-ramp");
  }
}

// A run of the demo's rig whose moves begin up to 20 ms late and whose messages are late too.
CapturedRun late_run(std::uint64_t seed) {
  CapturedRun run = test::in_memory_run(test::demo_truth(10, seed), test::demo_run().plan);
  run.events = {{0.0, "tare", "0.013", ""}};
  const double surface_m = test::demo_truth(10, seed).surface_position_m;
  run.events.push_back({0.0, "contact", std::to_string(surface_m), ""});
  return run;
}

TEST_CASE("the exported table of a run is fitted to the answer of its capture", "[cli][capture]") {
  const ScratchFolder folder;
  int n_inside = 0;
  for (const std::uint64_t seed : {1u, 2u, 3u, 4u, 5u}) {
    const CapturedRun run = late_run(seed);
    const std::string path = folder / "run.csv";
    write_file(path, table_from_capture(run), true);
    const FitResult capture = fit_indentation(indentation_from_capture(run));
    const FitResult table = fit_of_table(path, run.specimen);
    check_same_answer(table, capture);
    n_inside += half_widths_apart(table, capture) < 1.0 ? 1 : 0;
  }
  CHECK(n_inside >= 4);  // of 5 intervals of 95 %
}

TEST_CASE("a capture on the emulator, its export and the fit of the table give one answer",
          "[cli][capture][pty]") {
  const ScratchFolder folder;
  const std::string capture = folder / "run.viscap";
  const std::string table = folder / "run.csv";
  const std::string demo = VISCARD_SOURCE_DIR "/data/demo/";
  REQUIRE(test::run_command({"capture", "--emulate", "--test", demo + "02_test.toml", "--specimen",
                             demo + "03_pdms_1to10.toml", "--speed", "50", "--out", capture})
              .status == kDone);
  REQUIRE(test::run_command({"export", capture, "--out", table}).status == kDone);
  const FittedFile fitted = fit_file(capture, {});
  CHECK(fitted.n_before_test == 0);  // the fit of a capture finds the test by its moves
  const test::CommandOutcome printed = test::run_command({"fit", table, "--punch-diameter", "5mm"});
  CHECK(contains(printed.out, "before the first baseline"));
  const FitResult of_table = fit_of_table(table, fitted.specimen);
  check_same_answer(of_table, fitted.result);
  // Real ports make each run a little different, so one in twenty would be outside one half-width.
  CHECK(half_widths_apart(of_table, fitted.result) < 2.0);
}

std::size_t times_in(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

TEST_CASE("rows of the homing after a test are not called rows before it", "[cli][capture][pty]") {
  const ScratchFolder folder;
  const std::string demo = VISCARD_SOURCE_DIR "/data/demo/";
  std::string rig = read_file(demo + "01_rig.toml");
  const std::string not_homed = "home = false";
  rig.replace(rig.find(not_homed), not_homed.size(), "home = true");
  write_file(folder / "rig.toml", rig, true);
  const std::string capture = folder / "run.viscap", table = folder / "run.csv";
  const auto captured = test::run_command(
      {"capture", "--emulate", "--rig", folder / "rig.toml", "--test", demo + "02_test.toml",
       "--specimen", demo + "03_pdms_1to10.toml", "--speed", "500", "--out", capture});
  INFO(captured.err);
  REQUIRE(captured.status == kDone);
  REQUIRE(test::run_command({"export", capture, "--out", table}).status == kDone);
  const std::string text = read_file(table);
  const std::size_t n_homing = times_in(text, ",home,");
  REQUIRE(n_homing > 0);
  const std::size_t baseline = text.find(",baseline,");
  REQUIRE(baseline != std::string::npos);
  const std::size_t header = text.find("time_s,");
  const std::size_t n_before = times_in(text.substr(header, baseline - header), "\n") - 1;
  const std::vector<std::string> words{"fit", table, "--punch-diameter", "4.4 mm"};
  std::vector<std::string> as_json = words;
  as_json.emplace_back("--json");
  const auto json = nlohmann::json::parse(test::run_command(as_json).out);
  CHECK(json["n_before_test"] == n_before);
  CHECK(json["left_out"]["before_test"] == n_before);
  CHECK(json["left_out"]["after_test"] == n_homing);
  CHECK(json["n_left_out"].get<std::size_t>() >= n_before + n_homing);
  CHECK(contains(test::run_command(words).out,
                 std::to_string(n_homing) + " rows of the homing after the test"));
}

// The run in a capture whose rig file was changed afterwards.
std::string damaged_capture(const ScratchFolder& folder, const CapturedRun& run) {
  std::string path = folder / "run.viscap";
  CaptureWriter writer(path, run);
  for (const RunEvent& event : run.events) writer.append(event);
  for (const CommandedMove& move : run.moves) writer.append(move);
  for (const StageReport& report : run.stage_reports) writer.append(report);
  for (const LoadSample& sample : run.load_samples) writer.append(sample);
  writer.finish("finished");
  Database(path, Database::Access::kReadWrite)
      .execute("UPDATE run SET value = value || ' ' WHERE key = 'rig_toml'");
  return path;
}

TEST_CASE("the table of a damaged capture is refused as the capture is, or flagged",
          "[cli][capture]") {
  const ScratchFolder folder;
  const std::string capture = damaged_capture(folder, late_run(1)), table = folder / "run.csv";
  const std::string specimen = VISCARD_SOURCE_DIR "/data/demo/03_pdms_1to10.toml";
  REQUIRE(test::run_command({"export", capture}).status == kFailed);
  REQUIRE(test::run_command({"export", capture, "--unverified", "--out", table}).status == kDone);
  const std::string text = read_file(table), mark = "# damage: unverified: ";
  REQUIRE(contains(text, mark));
  SECTION("as it is written") {}
  SECTION("as it was written before the name of the flag stood in it") {
    write_file(table, std::string(text).replace(text.find(mark), mark.size(), "# damage: "), true);
  }
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"fit", table, "--specimen", specimen},
        {"report", table, "--out", folder / "r.html"},
        {"calibrate", "--compliance", "--data", table, "--out", folder / "f.toml"}}) {
    const auto refused = test::run_command(words);
    CAPTURE(words[0], refused.err);
    CHECK(refused.status == kFailed);
    CHECK(contains(refused.err, "run.csv: was exported from a damaged capture"));
    CHECK(contains(refused.err, "--unverified"));
  }
  FitRequest request;
  request.specimen = late_run(1).specimen;
  request.accepts_unverified = true;
  const FitResult accepted = fit_file(table, request).result;
  CHECK_FALSE(accepted.is_trustworthy);
  CHECK(std::count_if(accepted.flags.begin(), accepted.flags.end(),
                      [](const MaterialFlag& flag) { return flag.name == "unverified"; }) == 1);
  CHECK(test::run_command({"fit", table, "--specimen", specimen, "--unverified"}).status ==
        kFailed);
}

TEST_CASE("a comment about damage in the table of another program means nothing",
          "[cli][capture]") {
  const CsvTable table = csv_from_text("# damage: 0.3\ntime_s,force_N\n0,1\n1,2\n", "a.csv");
  CHECK(table.comments == std::vector<std::string>{"damage: 0.3"});
  CHECK(damage_of_table(table).empty());
}

TEST_CASE("moves of a run start where the force shows it", "[cli][capture]") {
  const test::RunConditions exact{.start_latency_s = 0.0};
  const CapturedRun truth =
      test::in_memory_run(test::demo_truth(10, 7), test::demo_run().plan, exact);
  CapturedRun run = truth;
  for (CommandedMove& move : run.moves) {
    move.move.start_time_s -= 0.015;
    move.start_uncertainty_s = 0.02;
  }
  const RunTiming timing = timing_from_capture(run);
  REQUIRE(timing.move_start_s.size() == truth.moves.size());
  for (std::size_t m = 0; m < truth.moves.size(); ++m) {
    INFO(truth.moves[m].purpose);
    CHECK(std::abs(timing.move_start_s[m] - truth.moves[m].move.start_time_s) < 1.5e-3);
  }
}

TEST_CASE("a run that cannot be fitted is exported with its recorded starts, and says so",
          "[cli][capture]") {
  CapturedRun run = late_run(1);
  run.moves.front().purpose = "approach";
  const RunTiming timing = timing_from_capture(run);
  CHECK(timing.move_start_s.front() == run.moves.front().move.start_time_s);
  CHECK(contains(table_from_capture(run), "cannot be fitted: the capture holds no ramp"));
}

TEST_CASE("readings after a restart of the amplifier's clock keep their receive times",
          "[cli][capture]") {
  CapturedRun run = late_run(1);
  const std::size_t restart = run.load_samples.size() - 100;
  for (std::size_t i = restart; i < run.load_samples.size(); ++i) {
    run.load_samples[i].device_time_s = 0.0125 * static_cast<double>(i - restart);
  }
  const std::vector<double> times_s = sample_times_s(run);
  CHECK(times_s[restart - 1] <= run.load_samples[restart - 1].host_time_s);
  CHECK(times_s[restart] == run.load_samples[restart].host_time_s);
  CHECK(times_s.back() == run.load_samples.back().host_time_s);
}

}  // namespace
}  // namespace viscard
