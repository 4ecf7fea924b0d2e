#include "rig/run/force_guard.h"

#include <cmath>
#include <utility>

namespace viscard {

ForceGuard::ForceGuard(const SafetyConfig& safety, double capacity_N)
    : warn_N_(safety.warn_fraction * capacity_N),
      soft_N_(safety.soft_fraction * capacity_N),
      hard_N_(safety.hard_fraction * capacity_N),
      rise_N_(0.005 * capacity_N) {}

GuardAction ForceGuard::take(double force_N, bool is_doubtful, double time_s, double period_s,
                             bool is_moving) {
  constexpr double kDoubtPeriods = 2.0;
  constexpr int kReadingsAfterStop = 2;
  const double load_N = std::abs(force_N);  // tension harms the cell too
  if (is_doubtful) {
    if (doubtful_until_s_) return GuardAction::kHardStop;
    doubtful_until_s_ = time_s + kDoubtPeriods * period_s;
    return GuardAction::kNone;
  }
  doubtful_until_s_.reset();
  const bool is_above = !(load_N < soft_N_);
  const bool was_above = std::exchange(was_above_, is_above);
  if (is_above && !was_above && !is_moving) return GuardAction::kNone;  // one garbled reading
  if (!(load_N < hard_N_)) return GuardAction::kHardStop;
  if (stop_force_N_) {
    const bool is_rising = load_N > *stop_force_N_ + rise_N_;
    return ++n_since_stop_ >= kReadingsAfterStop && is_rising ? GuardAction::kHardStop
                                                              : GuardAction::kNone;
  }
  if (load_N >= soft_N_) {
    stop_force_N_ = load_N;
    return GuardAction::kSoftStop;
  }
  if (load_N >= warn_N_ && !has_warned_) {
    has_warned_ = true;
    return GuardAction::kWarn;
  }
  return GuardAction::kNone;
}

GuardAction ForceGuard::silent_until(double time_s) {
  return doubtful_until_s_ && time_s > *doubtful_until_s_ ? GuardAction::kHardStop
                                                          : GuardAction::kNone;
}

}  // namespace viscard
