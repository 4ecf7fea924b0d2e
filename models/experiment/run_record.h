#pragma once

#include "models/experiment/motion_profile.h"

#include <cstdint>
#include <optional>
#include <string>
#include <variant>

namespace viscard {

// What a test run hands out while it happens, in order; the capture file stores each kind in a
// table of its own. host_time_s is CLOCK_MONOTONIC at the receive call, in s since the run began,
// times the declared speed of an emulated clock (1 on a real rig).

enum class Device { kStage = 0, kLoadCell = 1 };

// Bytes exactly as received, before any parsing; or as sent (is_sent).
struct RawBytes {
  Device device = Device::kStage;
  bool is_sent = false;
  double host_time_s = 0.0;
  std::string bytes;
};

// One reading of the load cell's amplifier.
struct LoadSample {
  std::int64_t index = 0;  // counts readings from 0
  double host_time_s = 0.0;
  std::optional<double>
      device_time_s;             // the amplifier's own clock, unwrapped; none if it sends none
  std::optional<double> counts;  // raw counts of the converter ...
  std::optional<double> volts;   // ... or volts, whichever the device sends
  bool is_saturated = false;     // converter at an end of its range
  bool is_glitch = false;        // a code the converter makes when its read is interrupted
  std::optional<double> force_N = {};  // ... or a force, from an instrument that knows its own gain
};

// One status report of the stage. Positions grow toward the specimen.
struct StageReport {
  double host_time_s = 0.0;
  double position_m = 0.0;
  std::string state;  // as reported: "Idle", "Jog", "Run", "Alarm" ...
};

// A move as commanded and, by the controller's settings, as it will be carried out (quantised ends,
// speed and acceleration as the controller uses them), handed out when it has ended. The true start
// lies within [0, start_uncertainty_s] after move.start_time_s, which is not before the command was
// written: position reports on the way narrow it down. A move that was stopped ends where it
// stopped.
struct CommandedMove {
  StageMove move;
  double start_uncertainty_s = 0.0;
  std::string purpose;  // "approach" | "ramp" | "unload" | "retract" | ...
};

// Phases and incidents. name is short and stable: "phase", "contact", "tare", "limit", "gap",
// "interrupted", "finished"; value is the phase's name or the number concerned.
struct RunEvent {
  double host_time_s = 0.0;
  std::string name;
  std::string value;
  std::string text;  // a sentence for a person
};

using RunRecord = std::variant<RawBytes, LoadSample, StageReport, CommandedMove, RunEvent>;

}  // namespace viscard
