#pragma once

#include "models/experiment/rig_config.h"
#include "rig/cells/load_cell.h"
#include "rig/lines/rig_clock.h"
#include "rig/stages/stage.h"

#include <string>
#include <vector>

namespace viscard {

// What a rig at rest says about itself.
struct RigCheck {
  std::string stage_identity;
  StageDynamics dynamics;
  double position_m = 0.0;
  ReportLatency latency;
  StreamCounts stream;
  std::string reads_as;             // of its numbers: "counts", "volts", "g" ...
  double rate_Hz = 0.0;             // of the readings, by the device's clock if it has one
  double jitter_s = 0.0;            // wall: largest delay of a reading over the smallest
  double force_N = 0.0;             // mean by the calibration, before any tare
  double noise_N = 0.0;             // standard deviation of one reading
  std::vector<std::string> advice;  // what to change and why
  bool is_usable = false;           // nothing among the advice forbids a run
};

// Opens the conversation with both devices, listens for duration_s of rig time and moves nothing.
// Throws RigError with the reason when a device does not answer.
RigCheck check_rig(Stage& stage, LoadCell& load_cell, const RigConfig& rig, const RigClock& clock,
                   double duration_s);

}  // namespace viscard
