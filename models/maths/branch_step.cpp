#include "models/maths/branch_step.h"

namespace viscard {

double phi1(double x) {
  if (x == 0.0) return 1.0;
  return -std::expm1(-x) / x;
}

double phi2(double x) {
  // Below about x = 1 the difference 1 - phi_1 cancels; the series sum (-x)^k/(k+2)! does not.
  if (x > 1.0) return (1.0 - phi1(x)) / x;
  double term = 0.5;
  double sum = term;
  for (int k = 1; k < 24; ++k) {
    term *= -x / static_cast<double>(k + 2);
    sum += term;
    if (std::abs(term) < 1e-17 * sum) break;  // what follows does not change the sum
  }
  return sum;
}

BranchStep::BranchStep(double dt_s, double tau_s, bool with_slope)
    : x(dt_s / tau_s),
      decay(std::exp(-x)),
      gain(phi1(x)),
      gain_slope(with_slope ? x * (gain - phi2(x)) : 0.0) {}

}  // namespace viscard
