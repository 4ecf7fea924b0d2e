#pragma once

#include "rig/emulator/rig_fault.h"

#include <algorithm>

namespace viscard {

// The motor and screw between the controller's count and the punch. Without a fault the punch is
// where the controller counts it.
class EmulatedMotor {
 public:
  // travel_scale: true travel over the counted one (an error of the screw's pitch).
  // lost_m: steps lost before; counted_m: at power-up.
  explicit EmulatedMotor(double travel_scale = 1.0, double lost_m = 0.0, double counted_m = 0.0)
      : scale_(travel_scale),
        lost_m_(lost_m),
        counted_m_(counted_m),
        punch_m_(counted_m - lost_m) {}

  void set_fault(RigFaultKind kind) { kind_ = kind; }
  // The true position when the controller counts counted_m and that force presses on the punch.
  double position_m(double counted_m, double force_N) {
    constexpr double kUnderLoad_N = 0.05;
    constexpr double kPlay_m = 30e-6;
    constexpr double kShareLost = 0.2;
    const double step_m = counted_m - counted_m_;
    counted_m_ = counted_m;
    if (kind_ == RigFaultKind::kDeadMotor) lost_m_ += step_m;
    if (kind_ == RigFaultKind::kLostSteps && step_m > 0.0 && force_N > kUnderLoad_N) {
      lost_m_ += kShareLost * step_m;
    }
    if (kind_ == RigFaultKind::kDirectionStuck && step_m < 0.0) lost_m_ += 2.0 * step_m;
    if (kind_ == RigFaultKind::kPlay) {
      // The punch stays while the screw turns through its play.
      const double free_m = counted_m - lost_m_ - punch_m_;
      punch_m_ += free_m > 0.0 ? free_m : std::min(0.0, free_m + kPlay_m);
    } else {
      punch_m_ = counted_m - lost_m_;
    }
    return scale_ * punch_m_;
  }
  // A sinking axis moves with the time, not with the count.
  bool is_sinking() const { return kind_ == RigFaultKind::kSinks; }
  void pass(double time_s) {
    constexpr double kSinks_m_s = 0.7e-3;
    if (is_sinking()) lost_m_ -= kSinks_m_s * time_s;
  }
  double lost_m() const { return lost_m_; }  // counted and not travelled

 private:
  double scale_;
  double lost_m_;
  double counted_m_;
  double punch_m_ = 0.0;
  RigFaultKind kind_ = RigFaultKind::kNone;
};

}  // namespace viscard
