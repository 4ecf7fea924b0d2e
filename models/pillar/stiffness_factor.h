#pragma once

#include "models/pillar/discrete_system.h"

#include <Eigen/SparseCholesky>

namespace viscard {

// L D L^T of a symmetric matrix that is positive definite, or quasi-definite as elasticity coupled
// to an electric potential is: for those the factors exist in any order of elimination. Source:
// Vanderbei, SIAM J. Optim. 5 (1995) 100.
//
// With a constraint, solve() returns the u that minimises u'Au/2 - r'u subject to C u = 0, where C
// is positive semidefinite (the volume form of an incompressible body) and already contained in the
// factored matrix with a large factor: Uzawa iterations on the pressures, each gaining that factor.
// Source: Fortin & Glowinski, Augmented Lagrangian Methods (1983), ch. 1.
class StiffnessFactor {
 public:
  // Throws std::runtime_error if the matrix is singular or has a wrong sign.
  void factor(const SymmetricSparse& matrix);
  // `constraint` must outlive the factor; `penalty` is its factor in the factored matrix.
  void constrain(const SymmetricSparse* constraint, double penalty);

  Eigen::VectorXd solve(const Eigen::VectorXd& right_side) const;

  // Number of negative pivots, which is the number of eigenvalues below zero (Sylvester).
  int negative_pivots() const;
  // Smallest over largest absolute pivot, a cheap sign of near-singularity.
  double pivot_ratio() const;

 private:
  Eigen::SimplicialLDLT<SymmetricSparse, Eigen::Lower> ldlt_;
  bool is_analysed_ = false;
  const SymmetricSparse* constraint_ = nullptr;
  double penalty_ = 0.0;
};

// y = A x for the stored lower triangle.
inline Eigen::VectorXd times(const SymmetricSparse& matrix, const Eigen::VectorXd& x) {
  return matrix.selfadjointView<Eigen::Lower>() * x;
}

}  // namespace viscard
