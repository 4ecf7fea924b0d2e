// Faulty amplifiers and lines, through real pseudo-terminals.
#include "rig/cells/hx711_load_cell.h"
#include "rig/emulator/pty_port.h"
#include "rig/lines/serial_line.h"
#include "rig/stages/grbl_stage.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace viscard {
namespace {

using Catch::Matchers::Contains;

// An amplifier that sends the bytes of a test.
struct ScriptedAmplifier {
  explicit ScriptedAmplifier(const std::string& line_format = "counts")
      : line(device.path(), 115200, clock), cell(line, config(line_format), clock, sink()) {}

  static LoadCellConfig config(const std::string& line_format) {
    LoadCellConfig result;
    result.line_format = line_format;
    return result;
  }
  RecordSink sink() {
    return [this](const RunRecord& record) { records.push_back(record); };
  }

  // Ten numbers counting up, each with that terminator, so that the driver connects.
  void connect(const std::string& end = "\n") {
    for (int i = 0; i < 10; ++i) send(std::to_string(1000 + i) + end);
    cell.connect([this] { serve(); });
  }
  void send(const std::string& bytes) { device.write(bytes); }
  void serve() {
    device.write("");
    wait_readable({&line}, clock, 0.002);
    cell.service();
  }
  // Lines "clock,reading" of a board that sends 80 a second.
  void send_timed(double first_ticks, double step, int n) {
    for (int i = 0; i < n; ++i) {
      const auto ticks =
          static_cast<std::uint32_t>(std::fmod(first_ticks + i * step, 4294967296.0));
      send(std::to_string(ticks) + "," + std::to_string(20000 + 7 * (i % 5)) + "\n");
    }
  }
  void serve_all() {
    for (int i = 0; i < 20; ++i) serve();
  }
  std::vector<double> counts() const {
    std::vector<double> values;
    for (const RunRecord& record : records) {
      const auto* sample = std::get_if<LoadSample>(&record);
      if (sample != nullptr && sample->counts) values.push_back(*sample->counts);
    }
    return values;
  }
  std::string error() {
    try {
      serve_all();
    } catch (const RigError& problem) {
      return problem.what();
    }
    return "";
  }

  PtyPort device;
  RigClock clock;
  SerialLine line;
  std::vector<RunRecord> records;
  Hx711LoadCell cell;
};

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

TEST_CASE("the record of an unreadable line is text, whatever its bytes were", "[rig][pty]") {
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

namespace {

std::deque<ReceivedLine> lines_of(const std::vector<std::string>& texts) {
  std::deque<ReceivedLine> lines;
  for (const std::string& text : texts) {
    lines.push_back({text, 0.0125 * static_cast<double>(lines.size())});
  }
  return lines;
}

std::string shown(const std::optional<Hx711Format>& format) {
  return format ? word_of(*format) : "uncertain";
}

// n lines of a clock that was at `from` and has begun anew after n_old of them.
std::deque<ReceivedLine> reset_lines(int n_old, double step, int n = 16, double from = 4.1e9) {
  std::vector<std::string> texts;
  for (int i = 0; i < n; ++i) {
    const double ticks = i < n_old ? from + i * step : 1000.0 + (i - n_old) * step;
    texts.push_back(std::to_string(std::llround(std::fmod(ticks, 4294967296.0))) + "," +
                    std::to_string(8000 + i % 3));
  }
  return lines_of(texts);
}

}  // namespace

TEST_CASE("the format is learnt in spite of a reset or a wrap among the first lines", "[rig]") {
  for (int n_old = 0; n_old < 14; ++n_old) {
    CAPTURE(n_old);
    CHECK(shown(learnt_hx711_format(reset_lines(n_old, 12500.0), 80.0)) == "micros,counts");
    CHECK(shown(learnt_hx711_format(reset_lines(n_old, 12.5), 80.0)) == "millis,counts");
    // A wrap of the counter after so many lines.
    const double before_wrap = 4294967296.0 - n_old * 12500.0;
    CHECK(shown(learnt_hx711_format(reset_lines(16, 12500.0, 16, before_wrap), 80.0)) ==
          "micros,counts");
  }
  // Six lines with a reset in the middle are a clock or nothing, but no decimal comma.
  for (int n_old = 1; n_old < 6; ++n_old) {
    const std::string six = shown(learnt_hx711_format(reset_lines(n_old, 12500.0, 6), 80.0));
    CHECK((six == "micros,counts" || six == "uncertain"));
  }
  // Two lines in garbage, one of them half a line.
  std::deque<ReceivedLine> garbled = reset_lines(3, 12500.0);
  garbled[5].text = "2\xff,80";
  garbled[9].text = "500";
  CHECK(shown(learnt_hx711_format(garbled, 80.0)) == "micros,counts");
}

TEST_CASE("a wrong expected rate makes no decimal comma of a clock", "[rig]") {
  for (const double rate_Hz : {10.0, 1000.0, 4000.0}) {
    CAPTURE(rate_Hz);
    CHECK(shown(learnt_hx711_format(reset_lines(4, 12500.0), rate_Hz)) == "micros,counts");
  }
}

TEST_CASE("numbers with a decimal comma are no clock", "[rig]") {
  CHECK(shown(learnt_hx711_format(lines_of({"0,12", "0,13", "0,12", "0,11", "0,12", "0,13"}),
                                  80.0)) == "volts");
  // A mean in counts: its noise makes steps such as a clock's.
  std::vector<std::string> texts;
  for (int i = 0; i < 16; ++i) {
    const long long whole = 8388 + std::llround(40.0 * std::sin(2.4 * i * i));
    texts.push_back(std::to_string(whole) + ",5");
  }
  CHECK(shown(learnt_hx711_format(lines_of(texts), 80.0)) == "counts");
}

TEST_CASE("a declared format that cannot be right is refused with the right one", "[rig][pty]") {
  const std::string declared = GENERATE("counts", "volts", "millis,counts");
  ScriptedAmplifier amplifier(declared);
  amplifier.send_timed(5e6, 12500.0, 40);
  INFO(declared);
  CHECK_THROWS_WITH(amplifier.cell.connect([&] { amplifier.serve(); }),
                    Contains("line_format = \"" + declared + "\"") && Contains("cannot be right") &&
                        Contains("Set line_format = \"micros,counts\""));
}

TEST_CASE("an amplifier that restarts before the tare is learnt anew", "[rig][pty]") {
  const std::string declared = GENERATE("auto", "micros,counts");
  ScriptedAmplifier amplifier(declared);
  amplifier.cell.accept_restarts(true);
  amplifier.send_timed(9e8, 12500.0, 30);  // lines from before the board's reset
  amplifier.cell.connect([&] { amplifier.serve(); });
  amplifier.serve_all();
  amplifier.send("HX711 ready\n");
  amplifier.send_timed(2e4, 12500.0, 40);
  amplifier.serve_all();
  CHECK(amplifier.cell.n_restarts() == 1);
  CHECK(shown(amplifier.cell.format()) == "micros,counts");
  double last_s = 0.0;
  for (const RunRecord& record : amplifier.records) {
    const auto* sample = std::get_if<LoadSample>(&record);
    if (sample == nullptr) continue;
    REQUIRE(sample->device_time_s);
    CHECK(*sample->device_time_s > last_s);
    last_s = *sample->device_time_s;
  }
  CHECK(amplifier.cell.counts().missing == 0);
  amplifier.cell.accept_restarts(false);
  amplifier.send_timed(2e4, 12500.0, 4);
  CHECK_THAT(amplifier.error(), Contains("restarted in the middle of the run"));
}

}  // namespace viscard
