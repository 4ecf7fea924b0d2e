#pragma once

#include "rig/cells/hx711_load_cell.h"
#include "rig/emulator/pty_port.h"
#include "rig/lines/rig_error.h"
#include "rig/lines/serial_line.h"

#include <cmath>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace viscard {

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

}  // namespace viscard
