#pragma once

#include "models/experiment/rig_config.h"
#include "rig/cells/load_cell.h"
#include "rig/lines/rig_clock.h"
#include "rig/sensors/thermometer.h"
#include "rig/stages/stage.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace viscard {

// What is measured and read from a rig at rest.
struct RigCheck {
  std::string stage_identity;
  StageDynamics dynamics;
  double position_m = 0.0;
  ReportLatency latency;
  StreamCounts stream;
  std::string reads_as;   // assumed unit of the readings: "counts", "volts", "g" ...
  double rate_Hz = 0.0;   // of readings, by the device's clock if it has one
  double jitter_s = 0.0;  // largest minus smallest delay of a reading, wall time
  // Increase of the readings' delay per second, by the device's clock: above 0 if the line carries
  // less than the device sends.
  double falls_behind = 0.0;
  bool is_stream = false;           // the instrument sends readings by itself
  bool has_clock = false;           // the lines carry the device's own time
  double line_bytes = 0.0;          // of one reading, with its terminator
  double force_N = 0.0;             // mean by the calibration, without a tare
  double noise_N = 0.0;             // standard deviation of one reading
  std::vector<std::string> advice;  // what to change and why
  // The readings show the noise of a converter; otherwise only an answer to a touch proves that the
  // cell measures.
  bool is_proven = false;
  bool is_usable = false;  // true if no piece of advice forbids a run
  // Of a rig with a thermometer: its newest temperature, and what is wrong with it.
  bool has_thermometer = false;
  std::optional<double> temperature_C;
  std::size_t n_temperatures = 0;
  std::string thermometer_trouble;
  // Longest delay of this computer while it listened; if it is long, no measured value is reliable.
  double late_s = 0.0;
};

// Connects both devices and listens for duration_s of rig time; moves nothing. Throws RigError if a
// device does not answer or fewer than ten usable readings arrive.
//
// thermometer: may be nullptr. If it has sent nothing by then, it is waited for until it counts as
// silent.
RigCheck check_rig(Stage& stage, LoadCell& load_cell, const RigConfig& rig, const RigClock& clock,
                   double duration_s, Thermometer* thermometer = nullptr);

}  // namespace viscard
