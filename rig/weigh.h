#pragma once

#include "models/experiment/rig_config.h"
#include "rig/cells/load_cell.h"
#include "rig/lines/rig_clock.h"

#include <atomic>
#include <functional>
#include <vector>

namespace viscard {

// One weight on the load cell.
struct WeighedLoad {
  double force_N = 0.0;
  double reading = 0.0;  // mean, in the unit of models/experiment/sample_force.h
  double sd = 0.0;       // standard deviation of one reading
  int n = 0;
};

struct WeighOptions {
  double settle_s = 1.0;   // from the moment the weight hangs until its readings count
  double mean_s = 3.0;     // length of the mean
  double largest_N = 0.0;  // of all loads, if these are some of them; a drift is judged by it
  // Puts a weight on, or asks a person to, and returns when it hangs; false ends the weighing.
  std::function<bool(double force_N)> put_on;
  const std::atomic<bool>* stop = nullptr;
};

// Weighs one load after another; times in rig seconds. Throws RigError if readings stop or are
// saturated, or if they still drift by more than a thousandth of the largest load during the mean.
std::vector<WeighedLoad> weigh(LoadCell& load_cell, const RigConfig& rig, const RigClock& clock,
                               const std::vector<double>& forces_N, const WeighOptions& options);

}  // namespace viscard
