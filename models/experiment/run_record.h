#pragma once

#include "models/experiment/motion_profile.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>

namespace viscard {

// The records of a test run, in order; the capture file stores each kind in a table of its own.
// host_time_s is CLOCK_MONOTONIC at the receive call, in s since the run began, times the declared
// speed of an emulated clock (1 on a real rig).

// The devices of a rig.
enum class Device { kStage = 0, kLoadCell = 1, kThermometer = 2 };

// The word for a device in captures and tables.
inline const char* word_of(Device device) {
  constexpr const char* kWords[] = {"stage", "load_cell", "thermometer"};
  return kWords[static_cast<std::size_t>(device)];
}

// Bytes exactly as received, before any parsing, or as sent (is_sent).
struct RawBytes {
  Device device = Device::kStage;
  bool is_sent = false;
  double host_time_s = 0.0;
  std::string bytes;
};

// One reading of the load cell's amplifier.
struct LoadSample {
  std::int64_t index = 0;  // number of the reading, from 0; a restart skips some
  double host_time_s = 0.0;
  // Time of the amplifier's own clock, unwrapped; nothing if the device sends none.
  std::optional<double> device_time_s;
  std::optional<double> counts;        // raw counts of the converter ...
  std::optional<double> volts;         // ... or volts ...
  bool is_saturated = false;           // the converter is at an end of its range
  bool is_glitch = false;              // a code that an interrupted conversion makes
  std::optional<double> force_N = {};  // ... or a force, from an instrument that knows its own gain
};

// One reading of the thermometer beside the specimen.
struct TemperatureSample {
  double host_time_s = 0.0;
  double temperature_C = 0.0;
};

// One status report of the stage. Positions grow toward the specimen.
struct StageReport {
  double host_time_s = 0.0;
  double position_m = 0.0;
  std::string state;  // as reported: "Idle", "Jog", "Run", "Alarm" ...
};

// A move as the controller carries it out by its settings: ends on whole steps, speed and
// acceleration as the controller uses them. It is recorded when it has ended. The true start lies
// between move.start_time_s and start_uncertainty_s later; move.start_time_s is not before the
// command was written, and position reports during the move narrow it down. A move that was stopped
// ends where it stopped.
struct CommandedMove {
  StageMove move;
  double start_uncertainty_s = 0.0;
  std::string purpose;  // "approach" | "ramp" | "unload" | "retract" | ...
};

// Phases and incidents. name is short and stable: "phase", "contact", "tare", "limit", "gap",
// "interrupted", "finished" and so on; value is the name of the phase or the number concerned.
struct RunEvent {
  double host_time_s = 0.0;
  std::string name;
  std::string value;
  std::string text;  // a sentence for a person
};

// Any record.
using RunRecord =
    std::variant<RawBytes, LoadSample, StageReport, CommandedMove, RunEvent, TemperatureSample>;

}  // namespace viscard
