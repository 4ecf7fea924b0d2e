#include "models/maths/f_distribution.h"

#include <cmath>

namespace viscard {
namespace {

// The continued fraction of the incomplete beta function by the method of Lentz: NIST Digital Library
// of Mathematical Functions, 8.17.22 and 3.10(iii).
double beta_fraction(double x, double a, double b) {
  constexpr int kMost = 10000;
  constexpr double kTiny = 1e-300, kEnough = 1e-15;
  double c = 1.0, d = 1.0 - (a + b) * x / (a + 1.0);
  d = 1.0 / (std::abs(d) < kTiny ? kTiny : d);
  double product = d;
  const auto step = [&](double numerator) {
    d = 1.0 + numerator * d;
    c = 1.0 + numerator / c;
    d = 1.0 / (std::abs(d) < kTiny ? kTiny : d);
    if (std::abs(c) < kTiny) c = kTiny;
    product *= d * c;
    return d * c;
  };
  for (int m = 1; m < kMost; ++m) {
    const double k = m;
    step(k * (b - k) * x / ((a + 2.0 * k - 1.0) * (a + 2.0 * k)));
    const double last = step(-(a + k) * (a + b + k) * x / ((a + 2.0 * k) * (a + 2.0 * k + 1.0)));
    if (std::abs(last - 1.0) < kEnough) break;
  }
  return product;
}

// ln Gamma(a) without the global sign of std::lgamma, which threads share.
double ln_gamma(double a) {
  int sign = 0;
  return ::lgamma_r(a, &sign);
}

// Regularised incomplete beta function I_x(a, b), DLMF 8.17.2.
double incomplete_beta(double x, double a, double b) {
  if (x <= 0.0) return 0.0;
  if (x >= 1.0) return 1.0;
  const double ln_front =
      a * std::log(x) + b * std::log1p(-x) + ln_gamma(a + b) - ln_gamma(a) - ln_gamma(b);
  if (x < (a + 1.0) / (a + b + 2.0)) return std::exp(ln_front) * beta_fraction(x, a, b) / a;
  return 1.0 - std::exp(ln_front) * beta_fraction(1.0 - x, b, a) / b;
}

}  // namespace

double f_upper_tail(double f, double numerator_freedom, double denominator_freedom) {
  // Abramowitz & Stegun (1964), 26.6.2: Q(F | m, n) = I_x(n/2, m/2), x = n/(n + m F).
  const double n = denominator_freedom, m = numerator_freedom;
  return incomplete_beta(n / (n + m * f), 0.5 * n, 0.5 * m);
}

}  // namespace viscard
