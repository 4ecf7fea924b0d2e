#include "models/pillar/time/state_transition.h"

#include "models/maths/dense.h"
#include "models/maths/require.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace viscard {
namespace {

// Largest norm for which the approximant of degree 7 is exact to rounding (Higham, table 2.3).
constexpr double kPadeNorm = 0.95;

double column_norm(const Eigen::MatrixXd& matrix) {
  return matrix.size() == 0 ? 0.0 : matrix.cwiseAbs().colwise().sum().maxCoeff();
}

// exp(X) - 1 = 2 (V - U)^-1 U, U and V the odd and the even part of the approximant's numerator.
Eigen::MatrixXd exponential_change(const Eigen::MatrixXd& X) {
  constexpr double kPade[] = {17297280.0, 8648640.0, 1995840.0, 277200.0,
                              25200.0,    1512.0,    56.0,      1.0};
  const Eigen::Index n = X.rows();
  const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(n, n);
  const Eigen::MatrixXd X2 = X * X;
  const Eigen::MatrixXd X4 = X2 * X2;
  const Eigen::MatrixXd X6 = X4 * X2;
  const Eigen::MatrixXd odd = X * (kPade[7] * X6 + kPade[5] * X4 + kPade[3] * X2 + kPade[1] * one);
  const Eigen::MatrixXd even = kPade[6] * X6 + kPade[4] * X4 + kPade[2] * X2 + kPade[0] * one;
  return LuFactor(even - odd).solve(Eigen::MatrixXd(2.0 * odd));
}

}  // namespace

StateTransition::StateTransition(Eigen::MatrixXd rate_1_s, double longest_s, bool only_longest)
    : rate_1_s_(std::move(rate_1_s)), longest_s_(longest_s) {
  const double norm = column_norm(rate_1_s_) * longest_s;
  require(longest_s > 0.0 && std::isfinite(norm), "a transition needs a finite, positive time");
  while (std::ldexp(norm, -halvings_) > kPadeNorm) ++halvings_;
  Eigen::MatrixXd change = exponential_change(std::ldexp(longest_s, -halvings_) * rate_1_s_);
  for (int k = 0; k < halvings_; ++k) {
    Eigen::MatrixXd twice = 2.0 * change;  // (1 + F)^2 - 1 = 2 F + F^2
    twice.noalias() += change * change;
    if (!only_longest) change_.push_back(std::move(change));
    change = std::move(twice);
  }
  change_.push_back(std::move(change));
  std::reverse(change_.begin(), change_.end());
}

void StateTransition::advance(double dt_s, Eigen::VectorXd& x) const {
  double left = dt_s / longest_s_;
  require(left >= 0.0 && left <= 1.0 &&
              (left == 1.0 || static_cast<int>(change_.size()) == halvings_ + 1),
          "a transition cannot advance by this time");
  for (std::size_t k = 0; k < change_.size() && left > 0.0; ++k) {
    const double part = std::ldexp(1.0, -static_cast<int>(k));
    if (left < part) continue;
    x += change_[k] * x;
    left -= part;
  }
  // The rest is shorter than the shortest square root, where the series converges at once.
  Eigen::VectorXd term = x;
  for (int i = 1; i < 30 && left > 0.0; ++i) {
    term = (left * longest_s_ / i) * (rate_1_s_ * term);
    x += term;
    if (!(term.cwiseAbs().maxCoeff() > 1e-17 * x.cwiseAbs().maxCoeff())) break;
  }
}

}  // namespace viscard
