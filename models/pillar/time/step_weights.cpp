#include "models/pillar/time/step_weights.h"

#include "models/maths/branch_step.h"
#include "models/maths/gauss_legendre.h"

#include <cmath>

namespace viscard {

Eigen::VectorXd exponential_moments(double x, int highest) {
  Eigen::VectorXd moments = Eigen::VectorXd::Zero(highest + 1);
  // The upward recursion loses digits for x below about the power; quadrature does not.
  constexpr double kRecursionFrom = 6.0;
  if (x < kRecursionFrom) {
    static const QuadratureRule rule = gauss_legendre(14);
    for (std::size_t i = 0; i < rule.points.size(); ++i) {
      double value = rule.weights[i] * std::exp(-x * rule.points[i]);
      for (int p = 0; p <= highest; ++p) {
        moments[p] += value;
        value *= rule.points[i];
      }
    }
  }
  moments[0] = phi1(x);
  if (x >= kRecursionFrom) {
    const double decay = std::exp(-x);
    for (int p = 1; p <= highest; ++p) moments[p] = (p * moments[p - 1] - decay) / x;
  }
  return moments;
}

StepWeights::StepWeights(const std::vector<double>& earlier_over_h) {
  // Ends of the steps at e = 0 (new), 1, 1 + earlier..., measured backward from the end.
  std::vector<double> node = {0.0, 1.0};
  for (const double length : earlier_over_h) node.push_back(node.back() + length);
  const auto k = static_cast<Eigen::Index>(node.size()) - 1;  // degree
  rate_ = Eigen::MatrixXd::Zero(k, k);
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(k + 1);  // sum of Lagrange polynomials 0..m
  for (Eigen::Index m = 0; m < k; ++m) {
    Eigen::VectorXd polynomial = Eigen::VectorXd::Zero(k + 1);
    polynomial[0] = 1.0;
    for (Eigen::Index j = 0; j <= k; ++j) {
      if (j == m) continue;
      const double scale =
          1.0 / (node[static_cast<std::size_t>(m)] - node[static_cast<std::size_t>(j)]);
      Eigen::VectorXd next = -node[static_cast<std::size_t>(j)] * scale * polynomial;
      next.tail(k) += scale * polynomial.head(k);
      polynomial = next;
    }
    sum += polynomial;
    // u' ds = -du/de de
    for (Eigen::Index p = 0; p < k; ++p) rate_(m, p) = -static_cast<double>(p + 1) * sum[p + 1];
  }
}

Eigen::VectorXd StepWeights::at(double x) const {
  return rate_ * exponential_moments(x, static_cast<int>(rate_.cols()) - 1);
}

}  // namespace viscard
