#include "models/maths/gauss_legendre.h"

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace viscard {

// By the three-term recurrence.
LegendrePair legendre_pair(int n, double x) {
  LegendrePair pair{x, 1.0};
  for (int k = 2; k <= n; ++k) {
    const double next = ((2.0 * k - 1.0) * x * pair.value - (k - 1.0) * pair.previous) / k;
    pair = {next, pair.value};
  }
  return pair;
}

// Newton's method from the asymptotic positions of the roots.
QuadratureRule gauss_legendre(int count) {
  if (count < 1) throw std::invalid_argument("a quadrature rule needs at least one point");
  QuadratureRule rule;
  for (int i = 0; i < count; ++i) {
    double x = count == 1 ? 0.0 : std::cos(std::numbers::pi * (i + 0.75) / (count + 0.5));
    double derivative = 0.0;
    for (int iteration = 0; iteration < 100; ++iteration) {
      const auto [value, previous] = legendre_pair(count, x);
      derivative = count * (x * value - previous) / (x * x - 1.0);
      const double step = value / derivative;
      x -= step;
      if (std::abs(step) < 1e-16) break;
    }
    rule.points.push_back(0.5 * (1.0 - x));
    rule.weights.push_back(1.0 / ((1.0 - x * x) * derivative * derivative));
  }
  return rule;
}

}  // namespace viscard
