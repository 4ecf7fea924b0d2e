#pragma once

#include "models/experiment/rig_config.h"

#include <optional>

namespace viscard {

enum class GuardAction { kNone, kWarn, kSoftStop, kHardStop };

// Decides from the readings alone how to protect the load cell: warn, stop with deceleration, or
// stop at once. While the stage moves, one reading above a limit is enough; at rest the next one
// must be above it too, because a garbled digit must not end a long hold. After a doubtful reading
// (the code of an interrupted or saturated conversion, or no number) the guard waits for the next
// one; if that is doubtful too or does not arrive in time, the stage is stopped at once.
class ForceGuard {
 public:
  ForceGuard(const SafetyConfig& safety, double capacity_N);

  // One reading from the tare. period_s: time between readings.
  GuardAction take(double force_N, bool is_doubtful, double time_s, double period_s,
                   bool is_moving = true);
  // To be called while the stage moves: no reading has arrived up to time_s.
  GuardAction silent_until(double time_s);

  double soft_limit_N() const { return soft_N_; }
  double hard_limit_N() const { return hard_N_; }

 private:
  double warn_N_, soft_N_, hard_N_;
  double rise_N_;  // a rise above this after a stop counts as still rising
  bool has_warned_ = false;
  std::optional<double> stop_force_N_;  // force at the decelerating stop
  int n_since_stop_ = 0;
  bool was_above_ = false;  // the last reading, made at rest, was above the soft limit
  std::optional<double> doubtful_until_s_;
};

}  // namespace viscard
