// The format of an amplifier's lines, learnt or declared, and restarts while it is learnt.
#include "rig/cells/hx711_format.h"
#include "tests/rig/cells/scripted_amplifier.h"

#include <catch2/catch.hpp>

namespace viscard {
namespace {

using Catch::Matchers::Contains;

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

TEST_CASE("lines that come twice have a clock nevertheless, and count once", "[rig][pty]") {
  ScriptedAmplifier amplifier("auto");
  for (int i = 0; i < 60; ++i) {
    const std::string text =
        std::to_string(5'000'000 + 12500 * i) + "," + std::to_string(8000 + i % 3) + "\n";
    amplifier.send(text + text);
  }
  amplifier.cell.connect([&] { amplifier.serve(); });
  amplifier.serve_all();
  CHECK(shown(amplifier.cell.format()) == "micros,counts");
  CHECK(amplifier.cell.counts().received > 40);
  CHECK(amplifier.cell.counts().duplicate >= amplifier.cell.counts().received - 1);
  for (const double counts : amplifier.counts()) CHECK(counts < 9000.0);
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
