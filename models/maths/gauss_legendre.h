#pragma once

#include <vector>

namespace viscard {

// Gauss-Legendre rule on (0, 1), exact for polynomials of degree 2 count - 1. Points ascend,
// weights sum to 1. Source: Abramowitz & Stegun (1964), 25.4.29. Throws std::invalid_argument for
// count < 1.
struct QuadratureRule {
  std::vector<double> points;
  std::vector<double> weights;
};
QuadratureRule gauss_legendre(int count);

}  // namespace viscard
