#include "io/capture/capture_export.h"
#include "io/capture/capture_file.h"
#include "io/tables/column_map.h"
#include "tests/io/capture/capture_samples.h"
#include "tests/support/golden.h"
#include "tests/support/scratch_folder.h"
#include "tests/support/without_commit.h"

#include <catch2/catch.hpp>

#include <cmath>

namespace viscard {
namespace {

// A short run with everything that the table shows.
CapturedRun short_run() {
  CapturedRun run = test::demo_run();
  run.status = "interrupted";
  run.started_at = "2026-11-21T09:00:00Z";
  run.program = "viscard 0.1.0";
  run.moves = {{{0.02, 0.0, 1e-3, 0.05, 0.2}, 0.01, "approach"}};
  run.events = {{0.0, "phase", "tare", "Zero of the load cell"},
                {0.01, "tare", "0.02", "two\nlines"},
                {0.02, "phase", "hold", ""},
                {0.03, "contact", "0.0005", ""}};
  for (int i = 0; i < 6; ++i) run.load_samples.push_back(test::sample(i));
  run.load_samples[2].counts.reset();
  run.load_samples[3].device_time_s.reset();
  run.load_samples[4].is_saturated = true;
  run.load_samples[5].counts.reset();
  run.load_samples[5].volts = -0.25;
  run.load_samples[5].is_glitch = true;
  return run;
}

TEST_CASE("a capture as CSV describes itself and reads back", "[io][capture][golden]") {
  const std::string text = csv_from_capture(short_run());
  // 1e-12: the last digits of sums and products may differ between compilers.
  CHECK(test::golden_difference("capture_export.csv", test::without_commit(text), 1e-12) == "");
  const CsvTable table = csv_from_text(text, "run.csv");
  CHECK(column_SI(table, "time_s").size() == 6);
  CHECK(column_text(table, "segment") ==
        std::vector<std::string>{"tare", "tare", "hold", "hold", "hold", "hold"});
  CHECK(column_SI(rows_of_segment(table, "tare"), "force_N").size() == 2);
}

TEST_CASE("force, stage position and depth of the CSV follow calibration, moves and frame",
          "[io][capture]") {
  const CapturedRun run = short_run();
  const CsvTable table = rows_of_segment(csv_from_text(csv_from_capture(run), "run.csv"), "tare");
  // By hand: 1001 counts of 20 V/2^24 each through 0.7255 V/N, minus the tare of 20 mN. 1e-14:
  // rounding.
  const double force_N = 1001.0 * 20.0 / 16777216.0 / 0.7255 - 0.02;
  CHECK(column_SI(table, "force_N").at(1) == Approx(force_N).epsilon(1e-14));
  CHECK(column_SI(table, "depth_m").at(1) == Approx(0.0 - 0.0005 - force_N / 10e3).epsilon(1e-14));
}

TEST_CASE("without a contact there is no depth", "[io][capture]") {
  CapturedRun run = short_run();
  run.events.pop_back();
  CHECK(csv_from_capture(run).find("depth_m") == std::string::npos);
}

TEST_CASE("the newest temperature stands beside each reading, and none while there is none",
          "[io][capture]") {
  CapturedRun run = short_run();
  CHECK(csv_from_capture(run).find("temperature_C") == std::string::npos);
  run.rig.thermometer.driver = "text";
  run.temperatures = {{run.load_samples[1].host_time_s, 23.5},
                      {run.load_samples[3].host_time_s + 1e-6, 23.75}};
  run.load_samples.push_back(test::sample(6));
  run.load_samples.back().host_time_s = 10.0;  // the thermometer has been silent for 5 s
  const CsvTable table = csv_from_text(csv_from_capture(run), "run.csv");
  const std::vector<double> found = column_with_gaps_SI(table, "temperature_C");
  REQUIRE(found.size() == 7);
  CHECK(std::isnan(found[0]));
  CHECK(found[1] == 23.5);
  CHECK(found[3] == 23.5);
  CHECK(found[4] == 23.75);
  CHECK(std::isnan(found[6]));
}

TEST_CASE("bytes that are not text are escaped in the export", "[io][capture]") {
  CapturedRun run = short_run();
  run.specimen.id = "gel \xc2\xb5-7";  // a character of UTF-8 stays
  run.events.push_back({0.04, "load_cell_unreadable", "12\xff\xc3(", "half \xe2\x82"});
  const std::string csv = csv_from_capture(run);
  CHECK(csv.find("# event at 0.040 s: load_cell_unreadable 12\\xff\\xc3( half \\xe2\\x82\n") !=
        std::string::npos);
  CHECK(csv.find("# specimen: gel \xc2\xb5-7, ") != std::string::npos);
}

TEST_CASE("raw bytes are exported so that each byte can be recovered", "[io][capture]") {
  const test::ScratchFolder folder;
  const auto path = folder / "run.viscap";
  CaptureWriter writer(path, test::demo_run());
  writer.append(RawBytes{Device::kStage, true, 0.5, "$J=G91 Z-0.1\n"});
  writer.append(RawBytes{Device::kLoadCell, false, 0.75, std::string("1,\"2\\\0\xff\r\n", 9)});
  writer.finish("finished");
  CHECK(csv_from_raw_bytes(path, read_capture(path)) ==
        "host_time_s,device,direction,bytes\n"
        "0.5,stage,sent,$J=G91 Z-0.1\\n\n"
        "0.75,load_cell,received,\"1,\"\"2\\\\\\x00\\xff\\r\\n\"\n");
}

}  // namespace
}  // namespace viscard
