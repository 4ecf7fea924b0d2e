#pragma once

#include "rig/lines/rig_clock.h"

#include <atomic>
#include <functional>
#include <string>

namespace viscard {

// What a person at the rig sees of a run, several times a second. Times in rig seconds.
struct RunProgress {
  double time_s = 0.0;  // since the run began
  std::string phase;
  double fraction = 0.0;  // of the whole run, by time
  double force_N = 0.0;   // newest force from the tare
  double depth_m = 0.0;   // indentation by the live contact point; 0 before contact
  double time_left_s = 0.0;
};

// How a run is observed and ended from outside.
struct RunControl {
  const RigClock* clock = nullptr;                   // the one the devices were made with
  const std::atomic<bool>* stop = nullptr;           // set by a signal handler to end the run
  std::function<void(const RunProgress&)> progress;  // may be empty
};

}  // namespace viscard
