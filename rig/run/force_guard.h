#pragma once

#include "models/experiment/rig_config.h"

#include <optional>

namespace viscard {

enum class GuardAction { kNone, kWarn, kSoftStop, kHardStop };

// The ladder that keeps a load cell whole, apart from any device: warn, decelerating stop,
// immediate stop. One reading above the hard limit is enough, unless it carries a code that an
// interrupted or saturated conversion makes: then the next reading decides, and if none comes in
// time it was true.
class ForceGuard {
 public:
  ForceGuard(const SafetyConfig& safety, double capacity_N);

  // One reading, in N from the tare; is_doubtful: glitch code, saturated, or no number at all.
  // period_s is the time between readings.
  GuardAction take(double force_N, bool is_doubtful, double time_s, double period_s);
  // No reading came until time_s.
  GuardAction silent_until(double time_s);

  double soft_limit_N() const { return soft_N_; }
  double hard_limit_N() const { return hard_N_; }

 private:
  double warn_N_, soft_N_, hard_N_;
  double rise_N_;  // what counts as still rising
  bool has_warned_ = false;
  std::optional<double> stop_force_N_;  // at the decelerating stop
  int n_since_stop_ = 0;
  std::optional<double> doubtful_until_s_;
};

}  // namespace viscard
