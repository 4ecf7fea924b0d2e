// A Mark-10 gauge in its continuous mode, through real pseudo-terminals.
#include "rig/protocols/gauge_protocols.h"
#include "rig/rig_check.h"
#include "tests/rig/cells/instrument_faults.h"

#include <iostream>

namespace viscard {
namespace {

using Catch::Matchers::Contains;

EmulatedRigOptions streaming_gauge() {
  EmulatedRigOptions options = DeviceFixture::options("grbl", "mark10-continuous");
  options.truth.surface_position_m = 0.1e-3;
  options.keeps_lines = true;
  return options;
}

// The newtons of every line that the gauge has sent, but for answers to its setup.
std::vector<double> newtons_sent(DeviceFixture& rig) {
  std::vector<double> newtons;
  LineSplitter splitter;
  for (const std::string& text : rig.emulated.sent_lines()) splitter.feed(text, 0.0);
  while (const auto line = splitter.next()) {
    const auto reading = parse_mark10_reading(line->text, "N");
    if (reading && reading->force_N) newtons.push_back(*reading->force_N);
  }
  return newtons;
}

bool was_sent(const DeviceFixture& rig, const std::string& words) {
  const auto raw = rig.all<RawBytes>();
  return std::any_of(raw.begin(), raw.end(), [&](const RawBytes& bytes) {
    return bytes.is_sent && bytes.device == Device::kLoadCell && bytes.bytes == words;
  });
}

}  // namespace

TEST_CASE("the continuous rate of a Mark-10 gauge is the smallest that is fast enough", "[rig]") {
  CHECK(mark10_stream_rate_Hz(80.0) == 125);
  CHECK(mark10_stream_rate_Hz(125.0) == 125);
  CHECK(mark10_stream_rate_Hz(1.0) == 2);  // AOUT1 means 50 readings a second
  CHECK(mark10_stream_rate_Hz(1000.0) == 250);
  CHECK(mark10_stream_command(125) == "AOUT125\r");
  CHECK(mark10_stream_command(0) == "AOUT0\r");
}

TEST_CASE("a gauge is set up for continuous mode from any state of its menu and of its stream",
          "[rig][pty]") {
  EmulatedRigOptions options = streaming_gauge();
  options.gauge.is_left_streaming = GENERATE(false, true);
  options.gauge.shows_peak = true;
  options.gauge.hides_unit = true;
  options.gauge.unit = "gF";
  DeviceFixture rig(options);
  rig.emulated.hang_weight(0.5);
  rig.devices.load_cell->connect(rig.pump());
  rig.emulated.hang_weight(0.0);
  CHECK(was_sent(rig, "AOUT125\r"));
  rig.records.clear();
  rig.pump_for(1.0);
  const auto samples = rig.all<LoadSample>();
  CHECK(samples.size() == Approx(125.0).margin(3.0));  // 1 s, and the ends of it
  // The peak would still show 0.5 N; without units gF would be read as N.
  CHECK(*samples.back().force_N ==
        Approx(options.truth.force_offset_N).margin(6 * options.truth.force_noise_N));
  CHECK(rig.devices.load_cell->counts().missing == 0);
}

TEST_CASE("a whole test runs on a gauge in continuous mode", "[rig][pty]") {
  DeviceFixture rig(streaming_gauge());
  const RunOutcome outcome = rig.run(shortest_test());
  INFO(outcome.reason);
  REQUIRE(outcome.status == "finished");
  const EmulatedOutcome bench = rig.emulated.outcome();
  CHECK(bench.peak_depth_m == Approx(0.13e-3).margin(8e-6));
  CHECK(outcome.peak_force_N == Approx(bench.peak_force_N).margin(5e-3));
  CHECK(outcome.stream.missing == 0);
  CHECK(outcome.stream.unreadable == 0);
}

TEST_CASE("a gauge without continuous mode, or one that changes its unit, is named", "[rig][pty]") {
  EmulatedRigOptions options = streaming_gauge();
  SECTION("series 4") {
    options.gauge.has_no_stream = true;
    DeviceFixture rig(options);
    CHECK_THROWS_WITH(rig.devices.load_cell->connect(rig.pump()),
                      Contains("AOUT125 ('*10')") && Contains("driver = \"mark10\""));
  }
  SECTION("unit") {
    options.gauge.changes_unit_after = 20;
    DeviceFixture rig(options);
    rig.devices.load_cell->connect(rig.pump());
    CHECK_THROWS_WITH(rig.pump_for(3.0), Contains("from 'N' to 'lbF'"));
  }
}

TEST_CASE("a gauge that is switched off in the hold ends the run within two seconds",
          "[rig][pty]") {
  EmulatedRigOptions options = streaming_gauge();
  options.gauge.stops_after_s = 12.0;
  DeviceFixture rig(options);
  TestPlan plan = shortest_test();
  plan.hold_s = 30.0;
  const RunOutcome outcome = rig.run(plan);
  CHECK(outcome.status == "interrupted");
  CHECK(outcome.phase == "hold");
  CHECK_THAT(outcome.reason, Contains("fell silent while the stage stood still"));
  CHECK(rig.emulated.outcome().final_position_m < options.truth.surface_position_m);
  const RunEvent last = rig.all<RunEvent>().back();
  CHECK(last.host_time_s - rig.all<LoadSample>().back().host_time_s < 4.0);  // with the lift
}

TEST_CASE("a rig check names the baud rate that the continuous mode needs", "[rig][pty]") {
  EmulatedRigOptions options = streaming_gauge();
  options.config.load_cell.expected_rate_Hz = 250.0;
  options.config.load_cell.baud = 19200;
  DeviceFixture rig(options);
  const RigCheck check =
      check_rig(*rig.devices.stage, *rig.devices.load_cell, rig.config, rig.clock, 2.0);
  CHECK_FALSE(check.is_usable);
  REQUIRE_FALSE(check.advice.empty());
  CHECK_THAT(check.advice.back(), Contains("baud or more"));
}

TEST_CASE("12 runs of a gauge in continuous mode over disturbed lines end well or give the reason",
          "[rig][pty][faults]") {
  FaultTally tally;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    CAPTURE(seed);
    run_disturbed(streaming_gauge(), seed, newtons_sent, tally);
  }
  std::cout << "12 runs of a Mark-10 in continuous mode over disturbed lines, " << tally.faults
            << " faults: " << tally.finished << " finished, " << tally.ended
            << " ended with a reason, " << tally.refused << " refused to start; of "
            << tally.readings << " readings " << tally.wrong
            << " were wrong and not marked (the worst by " << tally.worst
            << " of what is noticed)\n";
  CHECK(tally.faults > 12);
  CHECK(tally.finished > 3);
}

}  // namespace viscard
