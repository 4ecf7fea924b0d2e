#pragma once

#include "models/pillar/system/discrete_system.h"
#include "models/pillar/system/supernodal_factor.h"

#include <utility>

namespace viscard {

// L D L^T of a symmetric matrix that is positive definite, or quasi-definite as elasticity coupled
// to an electric potential is: for those the factors exist in any order of elimination. Source:
// Vanderbei, SIAM J. Optim. 5 (1995) 100.
//
// With a constraint, solve() returns the u that minimises u'Au/2 - r'u subject to C u = 0, where C
// is positive semidefinite (the volume form of an incompressible body) and already contained in the
// factored matrix with a large factor: conjugate gradients on the pressures, preconditioned by it.
// Source: Fortin & Glowinski, Augmented Lagrangian Methods (1983), ch. 1.
class StiffnessFactor {
 public:
  // Throws std::runtime_error if the matrix is singular or has a wrong sign.
  void factor(const SymmetricSparse& matrix);
  // `penalty` is the matrix C with the factor it has in the factored matrix.
  void constrain(SymmetricSparse penalty) { penalty_ = std::move(penalty); }

  // With a constraint, `pressure_source` (if asked for) is the w whose penalty force C w is the
  // force of the pressures: they are the penalty modulus times the projected div w. Without one it
  // is u.
  Eigen::VectorXd solve(const Eigen::VectorXd& right_side,
                        Eigen::VectorXd* pressure_source = nullptr) const;

  // Number of negative pivots, which is the number of eigenvalues below zero (Sylvester).
  int negative_pivots() const;

 private:
  void constrain_solution(Eigen::VectorXd& u, Eigen::VectorXd& source) const;

  SupernodalFactor ldlt_;
  bool is_analysed_ = false;
  SymmetricSparse penalty_;  // empty: no constraint
};

// y = A x for the stored lower triangle.
Eigen::VectorXd times(const SymmetricSparse& matrix, const Eigen::VectorXd& x);

// The whole matrix of a stored lower triangle.
inline Eigen::MatrixXd dense(const SymmetricSparse& lower) {
  Eigen::MatrixXd whole(lower);
  whole.triangularView<Eigen::StrictlyUpper>() = whole.transpose();
  return whole;
}

}  // namespace viscard
