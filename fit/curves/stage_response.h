#pragma once

#include "models/experiment/motion_profile.h"
#include "models/maths/branch_step.h"

#include <vector>

namespace viscard {

// A branch that one stage move drives: q(t) = int exp(-(t - s)/tau) v(s) ds over the part of the move after `from_s`, in
// m, in closed form at any time.
struct BranchResponse : BranchState {
  double rate_m_s = 0.0;  // dq/dt
};

// Other steps than BranchStep: not the position but the velocity of a move is linear between its knots. A step dt from velocity v_0 to v_1 takes q to
// exp(-x) q + dt [v_0 phi_1(x) + (v_1 - v_0) phi_2(x)], x = dt/tau (fit/README.md, eq. 3).
class StageResponse {
 public:
  // The same move, but it presses only from time from_s on (the contact).
  StageResponse(const StageMove& move, double from_s);

  // Response of the branch at the knots, for one relaxation time.
  struct Branch {
    double tau_s = 0.0;
    std::vector<BranchState> at_knots;
  };
  Branch branch(double tau_s) const;

  BranchResponse at(const Branch& branch, double time_s) const;

  double from_s() const { return knot_s_.front(); }
  double end_s() const { return knot_s_.back(); }

 private:
  std::vector<double> knot_s_;
  std::vector<double> velocity_m_s_;
};

// Time at which a move passes a position between its ends.
double time_at_position_s(const StageMove& move, double position_m);

}  // namespace viscard
