#pragma once

#include "rig/cells/load_cell.h"
#include "rig/run/preflight.h"

#include <optional>
#include <string>
#include <vector>

namespace viscard {

// How a run ended and what it amounts to.
struct RunOutcome {
  std::string
      status;  // "finished" | "interrupted" (asked to, or a device was lost) | "stopped" (a limit)
  std::string reason;  // why it did not finish, and what next; empty if it did
  Preflight expected;
  double noise_N = 0.0;  // of one reading, out of contact
  // A garbled digit that changes a reading by less than this can hide between its neighbours; on a
  // ramp, by less than twice the step between readings too; in the first five and the last two, by
  // up to twice as much.
  double hidden_error_N = 0.0;
  bool has_begun = false;  // anything was moved: else the record says nothing of the specimen
  std::optional<double> contact_position_m;  // live estimate; the fit finds it better
  double peak_force_N = 0.0;
  double achieved_depth_m = 0.0;  // the deepest, by that estimate
  StreamCounts stream;
  std::vector<std::string> doubts;  // what speaks against the record although the run finished
};

}  // namespace viscard
