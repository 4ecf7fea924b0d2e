#pragma once

#include <Eigen/Core>

#include <vector>

namespace viscard {

// int_0^1 exp(-x e) e^p de for p = 0 to highest and x >= 0, accurate to a few rounding errors.
Eigen::VectorXd exponential_moments(double x, int highest);

// A step of length h ends at t_1. The steps before it have the lengths earlier_over_h * h, latest
// first. The displacement is the polynomial through the ends of all these steps, and
//   int_step exp(-(t_1 - s)/tau) u'(s) ds = sum_m weight_m (increment of step m)
// with m = 0 for the new step and x = h/tau (eq. 17). One earlier step gives degree 2, none degree
// 1 (weight phi_1). For x -> inf, h/tau * weight tends to backward differentiation of that order.
class StepWeights {
 public:
  explicit StepWeights(const std::vector<double>& earlier_over_h);
  int count() const { return static_cast<int>(rate_.rows()); }
  Eigen::VectorXd at(double x) const;  // count() weights

 private:
  Eigen::MatrixXd rate_;  // [m][p]: coefficient of e^p in the rate that increment m contributes
};

}  // namespace viscard
