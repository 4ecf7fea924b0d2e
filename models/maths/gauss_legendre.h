#pragma once

#include <vector>

namespace viscard {

// Gauss-Legendre rule on (0, 1), exact to degree 2 count - 1. Points ascend, weights sum to 1.
// Source: Abramowitz & Stegun (1964), 25.4.29. Throws std::invalid_argument for count < 1.
struct QuadratureRule {
  std::vector<double> points;
  std::vector<double> weights;
};
QuadratureRule gauss_legendre(int count);

// Legendre polynomials P_n and P_(n - 1) at x, n >= 1.
struct LegendrePair {
  double value = 0.0;
  double previous = 0.0;
};
LegendrePair legendre_pair(int n, double x);

}  // namespace viscard
