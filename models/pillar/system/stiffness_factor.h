#pragma once

#include "models/pillar/system/discrete_system.h"
#include "models/pillar/system/supernodal_factor.h"

#include <functional>
#include <utility>
#include <vector>

namespace viscard {

struct NearbySolutions;

// L D L^T of a symmetric matrix that is positive definite or quasi-definite (elasticity coupled to
// an electric potential). For such matrices the factors exist in any elimination order. Source:
// Vanderbei, SIAM J. Optim. 5 (1995) 100.
//
// With a constraint, solve() returns the u that minimises u'Au/2 - r'u subject to C u = 0. C is
// positive semidefinite (the volume form of an incompressible body) and is part of the factored
// matrix with a large factor. The method is conjugate gradients on the pressures, preconditioned by
// the factored matrix. Source: Fortin & Glowinski, Augmented Lagrangian Methods (1983), ch. 1.
class StiffnessFactor {
 public:
  // Throws std::runtime_error if the matrix is singular or a pivot has the wrong sign.
  void factor(const SymmetricSparse& matrix);
  // `penalty` is the matrix C, scaled as it is in the factored matrix.
  void constrain(const SymmetricSparse& penalty) { penalty_ = penalty; }

  // product(u, source): the matrix times u; the part of a constraint acts on the source of the pressures.
  using Product = std::function<Eigen::VectorXd(const Eigen::VectorXd&, const Eigen::VectorXd&)>;
  // Instead of factor(): for a matrix close to one that is factored already. solve() is then exact to
  // first order in the difference and costs one solution with the known factors (NearbySolutions).
  // `known` must outlive this.
  void approximate(const NearbySolutions& known, Product product);
  // After factor(): solve() corrects its solutions by their rest under a product that keeps more digits than
  // the entries of the matrix (strains of a motion that is nearly rigid), until the corrections end. Where
  // the matrix is right to a share q, each correction gains a factor 1/q.
  // Source: Higham, Accuracy and Stability of Numerical Algorithms (2002), ch. 12.
  void refine_by(Product product) { product_ = std::move(product); }

  // With a constraint, `pressure_source` (if given) receives the w whose penalty force C w equals
  // the force of the pressures; the pressures are the penalty modulus times the projected div w.
  // Without a constraint it receives u.
  Eigen::VectorXd solve(const Eigen::VectorXd& right_side,
                        Eigen::VectorXd* pressure_source = nullptr) const;

  // Number of negative pivots, equal to the number of negative eigenvalues (Sylvester).
  int negative_pivots() const;

 private:
  Eigen::VectorXd solve_nearby(const Eigen::VectorXd& right_side,
                               Eigen::VectorXd* pressure_source) const;
  Eigen::VectorXd solve_once(const Eigen::VectorXd& right_side,
                             Eigen::VectorXd* pressure_source) const;
  void constrain_solution(Eigen::VectorXd& u, Eigen::VectorXd& source) const;

  SupernodalFactor ldlt_;
  bool is_analysed_ = false;
  SymmetricSparse penalty_;  // empty: no constraint
  const NearbySolutions* known_ = nullptr;
  Product product_;  // with known_, or to refine by
};

// A factored matrix K0 and some of its solutions, from which those of a matrix K close to it follow: with
// u0 of K0 u0 = f0 and a load f close to f0,
//   u = u0 + K0^-1 (f - K u0),
// one step of iterative refinement. Its value at K = K0 and its derivatives,
//   u' = K0^-1 (f' - K' u0),
// are those of K^-1 f, so differences of it give the derivatives of the solution with no further
// factorisation (eq. 26). Source: Haftka & Gurdal, Elements of Structural Optimization (1992), 7.2.
struct NearbySolutions {
  StiffnessFactor factor;
  std::vector<Eigen::VectorXd> loads, solutions, sources;  // sources of the pressures

  // Solves for a load and keeps the solution.
  void add(const Eigen::VectorXd& load);
};

// y = A x for the stored lower triangle.
Eigen::VectorXd times(const SymmetricSparse& matrix, const Eigen::VectorXd& x);

// The full matrix of a stored lower triangle.
inline Eigen::MatrixXd dense(const SymmetricSparse& lower) {
  Eigen::MatrixXd whole(lower);
  whole.triangularView<Eigen::StrictlyUpper>() = whole.transpose();
  return whole;
}

}  // namespace viscard
