#pragma once

#include <Eigen/Core>

#include <vector>

namespace viscard {

// x' = A x, advanced exactly over any time: x(t + dt) = exp(A dt) x(t). The matrix exponential of
// the longest step is found once by scaling and squaring with the Pade approximant of degree 7
// (Higham, SIAM J. Matrix Anal. Appl. 26 (2005) 1179); shorter steps use its square roots, the
// binary digits of dt. All matrices are exp(A dt) - 1, so that slow parts keep their digits.
class StateTransition {
 public:
  // With only_longest, no other step can be taken, which needs less memory.
  StateTransition(Eigen::MatrixXd rate_1_s, double longest_s, bool only_longest = false);

  // Throws std::invalid_argument for a step that is negative or longer than the longest.
  void advance(double dt_s, Eigen::VectorXd& x) const;

 private:
  Eigen::MatrixXd rate_1_s_;
  double longest_s_;
  int halvings_ = 0;
  std::vector<Eigen::MatrixXd> change_;  // exp(A longest/2^k) - 1 for k = 0, 1, ...
};

}  // namespace viscard
