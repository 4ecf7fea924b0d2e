#include "models/pillar/stiffness_factor.h"

#include <Eigen/Core>

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

void StiffnessFactor::constrain(const SymmetricSparse* constraint, double penalty) {
  constraint_ = constraint;
  penalty_ = penalty;
}

Eigen::VectorXd StiffnessFactor::solve(const Eigen::VectorXd& right_side) const {
  Eigen::VectorXd u = ldlt_.solve(right_side);
  if (constraint_ == nullptr) return u;
  Eigen::VectorXd pressure_force = Eigen::VectorXd::Zero(u.size());
  constexpr int kIterations = 8;  // each gains a factor of 1e3 or more; 4 suffice
  double last = u.norm();
  for (int i = 0; i < kIterations; ++i) {
    pressure_force += penalty_ * times(*constraint_, u);
    const Eigen::VectorXd next = ldlt_.solve(right_side - pressure_force);
    const double change = (next - u).norm();
    u = next;
    if (!(change < 0.5 * last)) break;  // rounding reached
    last = change;
  }
  return u;
}

int StiffnessFactor::negative_pivots() const {
  return static_cast<int>((ldlt_.vectorD().array() < 0.0).count());
}

double StiffnessFactor::pivot_ratio() const {
  const Eigen::VectorXd pivots = ldlt_.vectorD().cwiseAbs();
  return pivots.minCoeff() / pivots.maxCoeff();
}

}  // namespace viscard
