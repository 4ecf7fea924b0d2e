#pragma once

#include "models/experiment/rig_config.h"
#include "rig/run/force_readings.h"
#include "rig/run/life_watch.h"
#include "rig/stages/stage.h"

#include <string>
#include <vector>

namespace viscard {

// Of the capacity: a larger force before anything was touched ends a run.
inline constexpr double kPressesAtStart = 0.1;

// What the load cell of a rig at rest was seen to do.
struct RestReadings {
  double force_N = 0.0;  // mean by the calibration, without a tare
  double noise_N = 0.0;  // standard deviation of one reading
  Drift drift;
  double rate_Hz = 0.0;
  LifeSigns life;
};

// One thing that is wrong with a rig at rest.
struct RestFinding {
  enum class About { kSignal, kNoise, kDrift, kRate, kForce, kStage };
  About about = About::kSignal;
  std::string text;  // what (value and limit), and what to do
};

// Everything for which a test is refused, by `viscard rig check` and by a run alike, the cause
// before its consequences. A force at rest is the last one, because a run may be able to lift the
// punch from it.
std::vector<RestFinding> findings_at_rest(const RestReadings& seen, const RigConfig& rig);

// Settings of the controller that no stage has, such as those of an erased memory.
std::vector<RestFinding> findings_of_stage(const StageDynamics& dynamics);

// For a rig file that does not state when its load cell has answered to a force: the noise that
// proves the converter alive comes from the converter alone, also with an open wire of the cell.
inline constexpr const char* kUnanswered =
    "nothing has shown yet that the load cell feels a force: its noise is that of the converter "
    "and does not show an open wire. Touch it once with: viscard rig touch --rig FILE";

// Where the last digit of the readings exceeds their noise, equal readings are normal and prove
// nothing. True if the noise is seen, so that it proves the converter alive.
bool is_proven_by_noise(const RestReadings& seen);

}  // namespace viscard
