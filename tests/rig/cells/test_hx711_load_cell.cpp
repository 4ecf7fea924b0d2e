// Faulty amplifiers and lines, through real pseudo-terminals.
#include "rig/stages/grbl_stage.h"
#include "tests/rig/cells/scripted_amplifier.h"

#include <catch2/catch.hpp>

#include <string>
#include <variant>
#include <vector>

namespace viscard {
namespace {

using Catch::Matchers::Contains;

}  // namespace

TEST_CASE("readings that arrive in single bytes, or many in one read, are the same readings",
          "[rig][pty]") {
  const std::string end = GENERATE("\n", "\r", "\r\n", "\n\r");
  ScriptedAmplifier amplifier;
  amplifier.connect(end);
  amplifier.serve_all();
  amplifier.records.clear();
  const std::string text = "-8388600" + end + "12" + end + "0" + end + "77" + end;
  SECTION("single bytes") {
    for (const char c : text) {
      amplifier.send(std::string(1, c));
      amplifier.serve();
    }
  }
  SECTION("one read") {
    amplifier.send(text);
  }
  amplifier.send("5" + end);  // after CR alone, only the next byte shows that the line has ended
  amplifier.serve_all();
  const std::vector<double> counts = amplifier.counts();
  REQUIRE(counts.size() >= 4);
  CHECK(std::vector<double>(counts.begin(), counts.begin() + 4) ==
        std::vector<double>{-8388600.0, 12.0, 0.0, 77.0});
}

TEST_CASE("garbage before and between readings loses no other reading", "[rig][pty]") {
  ScriptedAmplifier amplifier;
  amplifier.send(std::string("\xff\x80\0\x01garbage\n\xc3\x28\n9\0", 17));
  amplifier.send("\nTare... put nothing on the scale\nReadings:\n");
  amplifier.connect();
  amplifier.serve_all();
  amplifier.records.clear();
  amplifier.send("100\n\x80\x81\xfe\n101\n" +
                 std::string("10\0"
                             "2\n",
                             5) +
                 "nonsense\n103\n");
  amplifier.serve_all();
  CHECK(amplifier.counts() == std::vector<double>{100.0, 101.0, 103.0});
  CHECK(amplifier.cell.counts().unreadable == 3);
}

TEST_CASE("the record of an unreadable line is text, for any bytes it had", "[rig][pty]") {
  ScriptedAmplifier amplifier;
  amplifier.connect();
  amplifier.send("10\xff\xfe\x07\n1011\n");
  amplifier.serve_all();
  std::string value;
  for (const RunRecord& record : amplifier.records) {
    const auto* event = std::get_if<RunEvent>(&record);
    if (event != nullptr && event->name == "load_cell_unreadable") value = event->value;
  }
  CHECK(value == "10\\xff\\xfe\\x07");
}

TEST_CASE("nan, inf, ovf and the ends of the range are handed out as saturated", "[rig][pty]") {
  ScriptedAmplifier amplifier;
  amplifier.connect();
  amplifier.serve_all();
  amplifier.records.clear();
  amplifier.send("nan\ninf\novf\n8388607\n-8388608\n1020\n-0.00\n");
  amplifier.serve_all();
  std::vector<LoadSample> samples;
  for (const RunRecord& record : amplifier.records) {
    if (const auto* sample = std::get_if<LoadSample>(&record)) samples.push_back(*sample);
  }
  REQUIRE(samples.size() == 7);
  for (int i = 0; i < 5; ++i) CHECK(samples[static_cast<std::size_t>(i)].is_saturated);
  CHECK_FALSE(samples[0].counts);
  CHECK(*samples[3].counts == 8388607.0);
  CHECK_FALSE(samples[5].is_saturated);
  CHECK(*samples[6].counts == 0.0);
}

TEST_CASE("a decimal comma is read if the format has no comma of its own", "[rig][pty]") {
  ScriptedAmplifier amplifier("volts");
  for (int i = 0; i < 10; ++i) amplifier.send("0,12" + std::to_string(i) + "\r\n");
  amplifier.cell.connect([&] { amplifier.serve(); });
  amplifier.send("-1,5\r\n");
  amplifier.serve_all();
  const auto* last = std::get_if<LoadSample>(&amplifier.records.back());
  REQUIRE(last != nullptr);
  CHECK(*last->volts == -1.5);
}

TEST_CASE("a unit that changes during the run ends it, and the reason names both units",
          "[rig][pty]") {
  ScriptedAmplifier amplifier("volts");
  for (int i = 0; i < 10; ++i) amplifier.send("12.5 g\n");
  amplifier.cell.connect([&] { amplifier.serve(); });
  amplifier.send("12.5 g\n0.44 lbs\n0.44 lbs\n0.44 lbs\n");
  CHECK_THAT(amplifier.error(), Contains("from 'g' to 'lbs'"));
}

TEST_CASE("one line with a garbled unit is left out and changes no unit", "[rig][pty]") {
  ScriptedAmplifier amplifier("volts");
  for (int i = 0; i < 10; ++i) amplifier.send("12.5 g\n");
  amplifier.cell.connect([&] { amplifier.serve(); });
  amplifier.serve_all();
  const std::int64_t n_before = amplifier.cell.counts().received;
  amplifier.send("12.5 g\n12.5 N\n12.5 g\n12.5 kg\n12.5 N\n12.5 g\n");
  CHECK(amplifier.error().empty());
  CHECK(amplifier.cell.counts().received == n_before + 3);
  CHECK(amplifier.cell.counts().unreadable == 3);
  CHECK(amplifier.cell.reads_as() == "g");
}

TEST_CASE("a missing converter is an error in the middle of a stream too", "[rig][pty]") {
  ScriptedAmplifier amplifier;
  amplifier.connect();
  amplifier.send("1011\nHX711 not found.\n");
  CHECK_THAT(amplifier.error(), Contains("HX711 not found") && Contains("wires"));
}

TEST_CASE("a wrong baud rate is suspected from unprintable bytes", "[rig][pty]") {
  // 115200 baud read at 57600: mostly bytes that no text contains.
  const std::string noise("\xf8\x1e\xe6\x80\x00\xfe\x66\x98\xe0\x86\x80\x78\x9e\x00\xf8\x86", 16);
  PtyPort device;
  const RigClock clock;
  SerialLine line(device.path(), 57600, clock);
  const RecordSink nowhere = [](const RunRecord&) {};
  const Pump pump = [&] {
    device.write(noise);
    wait_readable({&line}, clock, 0.01);
  };
  SECTION("stage") {
    GrblStage stage(line, StageConfig{}, clock, nowhere, 0.1);
    CHECK_THROWS_WITH(stage.connect([&] {
      pump();
      stage.service();
    }),
                      Contains("baud rate of 57600"));
  }
  SECTION("load cell") {
    Hx711LoadCell cell(line, LoadCellConfig{}, clock, nowhere, 0.05);
    CHECK_THROWS_WITH(cell.connect([&] {
      pump();
      cell.service();
    }),
                      Contains("baud rate of 57600"));
  }
}

}  // namespace viscard
