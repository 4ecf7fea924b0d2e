#pragma once

#include <cmath>

namespace viscard {

// phi_1(x) = (1 - exp(-x))/x and phi_2(x) = (1 - phi_1(x))/x   (eq. 6), for x >= 0, accurate to a
// few rounding errors from x = 0 to infinity: expm1 for phi_1, a series for phi_2 where it cancels.
double phi1(double x);
double phi2(double x);

// A step dt of a branch of time tau, q(t) = int exp(-(t - s)/tau) d(input): for an input that is linear in the step,
//   q <- decay q + gain d(input),   decay = exp(-x), gain = phi_1(x), x = dt/tau,
// exactly for any x. All Prony series of viscard step by it.
struct BranchStep {
  double x = 0.0, decay = 1.0, gain = 1.0;  // those of a jump
  double gain_slope = 0.0;  // d gain/d ln tau = x (phi_1 - phi_2), if it is asked for
  BranchStep() = default;
  BranchStep(double dt_s, double tau_s, bool with_slope = false);
};

// The steps of a branch along a record. Times read from text differ by rounding; such steps are taken as equal, and
// their factors are computed once.
class StepsOfBranch {
 public:
  explicit StepsOfBranch(double tau_s, bool with_slope = false)
      : tau_s_(tau_s), with_slope_(with_slope) {}
  const BranchStep& of(double dt_s) {
    if (!(std::abs(dt_s - dt_s_) <= 1e-10 * std::abs(dt_s_))) {
      dt_s_ = dt_s;
      step_ = BranchStep(dt_s, tau_s_, with_slope_);
    }
    return step_;
  }

 private:
  double tau_s_, dt_s_ = -1.0;
  bool with_slope_;
  BranchStep step_;
};

// q of a branch, and dq/d ln tau if the steps have slopes, in the unit of the input.
struct BranchState {
  double value = 0.0, slope = 0.0;
  void advance(const BranchStep& step, double change) {
    slope = step.decay * (slope + step.x * value) + change * step.gain_slope;
    value = step.decay * value + step.gain * change;
  }
};

}  // namespace viscard
