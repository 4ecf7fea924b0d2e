#pragma once

#include "models/experiment/run_temperature.h"
#include "rig/cells/load_cell.h"
#include "rig/run/preflight.h"
#include "rig/stages/stage.h"

#include <optional>
#include <string>
#include <vector>

namespace viscard {

// How a run ended and what it measured.
struct RunOutcome {
  // "finished" | "interrupted" (by a person or a lost device) | "stopped" (by a force limit)
  std::string status;
  std::string reason;  // why it did not finish and what to do; empty if it did
  std::string cause;   // the reason without the final position of the punch
  // Of an early end, for programs: "force-limit" | "interrupted" | "device-lost" |
  // "device-restarted" | "stage-alarm" | "readings-old" | "pressing" | "cell-dead" |
  // "no-response" | "wrong-way" | "not-lifted" | "device" | "failed".
  std::string code;
  std::string phase;  // the one in which it ended early
  Preflight expected;
  double noise_N = 0.0;  // standard deviation of one reading out of contact
  // A garbled digit that changes a reading by less than this is not detected at rest. On a ramp,
  // errors below twice the step between readings are not detected either; in the first five and the
  // last two readings the threshold is up to twice as high.
  double hidden_error_N = 0.0;
  // The stage was moved after the tare; otherwise the run contains no information about the
  // specimen.
  bool has_begun = false;
  std::optional<double> contact_position_m;  // live estimate; the fit finds a better one
  double peak_force_N = 0.0;
  double achieved_depth_m = 0.0;  // largest depth by the live estimate
  // What the depth is: "measured" by the stage's encoder; "counted" in steps; "compared": counted,
  // and the count was right when the stage was homed after the lift.
  std::string depth_is = "counted";
  std::optional<HomedStage> homed;  // before the test, if the driver compares its count
  std::optional<CountCheck> count;  // what homing after the lift has shown
  StreamCounts stream;
  // Delays of this computer in which nothing could be watched, of at least 0.1 s.
  int n_late = 0;
  double longest_late_s = 0.0;
  std::string line_format;  // of the load cell's lines as read; empty if its protocol fixes it
  std::optional<RunTemperature> temperature;  // by the thermometer, if it gave any
  std::string thermometer_trouble;            // why it gave none, or none at the end
  std::vector<std::string> doubts;            // reasons to distrust the record of a finished run
};

}  // namespace viscard
