#include "models/pillar/stiffness_factor.h"

#include <Eigen/Core>

#include <algorithm>
#include <stdexcept>

namespace viscard {

void StiffnessFactor::factor(const SymmetricSparse& matrix) {
  if (!is_analysed_) {
    ldlt_.analyzePattern(matrix);
    is_analysed_ = true;
  }
  ldlt_.factorize(matrix);
  if (ldlt_.info() != Eigen::Success || !ldlt_.vectorD().allFinite()) {
    throw std::runtime_error(
        "the stiffness matrix is singular: a part of the body is neither held nor joined to one "
        "that "
        "is, or a modulus is zero");
  }
}

Eigen::VectorXd StiffnessFactor::solve(const Eigen::VectorXd& right_side,
                                       Eigen::VectorXd* pressure_source) const {
  Eigen::VectorXd u = ldlt_.solve(right_side);
  Eigen::VectorXd added = Eigen::VectorXd::Zero(u.size());
  if (penalty_.size() > 0) constrain_solution(u, added);
  if (pressure_source != nullptr) *pressure_source = u + added;
  return u;
}

// Conjugate gradients for the pressures, whose force is C added beside the penalty's C u; u itself
// stands for the residual, its divergence.
void StiffnessFactor::constrain_solution(Eigen::VectorXd& u, Eigen::VectorXd& added) const {
  double violation = u.dot(times(penalty_, u));
  const double enough = 1e-26 * violation;
  double least = violation;
  Eigen::VectorXd direction = u;
  constexpr int kIterations = 60;  // about five suffice unless elements are very flat
  constexpr int kPatience = 3;     // iterations without gain: rounding reached
  int idle = 0;
  for (int i = 0; i < kIterations && violation > enough && idle < kPatience; ++i) {
    const Eigen::VectorXd C_direction = times(penalty_, direction);
    const Eigen::VectorXd response = ldlt_.solve(C_direction);
    const double step = violation / C_direction.dot(response);
    u -= step * response;
    added += step * direction;
    const double remaining = u.dot(times(penalty_, u));
    direction = u + remaining / violation * direction;
    violation = remaining;
    idle = remaining < 0.5 * least ? 0 : idle + 1;
    least = std::min(least, remaining);
  }
}

int StiffnessFactor::negative_pivots() const {
  return static_cast<int>((ldlt_.vectorD().array() < 0.0).count());
}

double StiffnessFactor::pivot_ratio() const {
  const Eigen::VectorXd pivots = ldlt_.vectorD().cwiseAbs();
  return pivots.minCoeff() / pivots.maxCoeff();
}

}  // namespace viscard
