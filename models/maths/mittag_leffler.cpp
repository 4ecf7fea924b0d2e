#include "models/maths/mittag_leffler.h"

#include "models/maths/text_of_number.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace viscard {

double mittag_leffler_decay(double alpha, double x) {
  if (!(alpha > 0.0 && alpha <= 1.0) || !(x >= 0.0)) {
    throw std::invalid_argument("Mittag-Leffler decay of order " + text_of(alpha) + " at x = " +
                                text_of(x) + ": the order must lie in (0, 1] and x be >= 0");
  }
  constexpr double kPi = std::numbers::pi;
  if (x == 0.0) return 1.0;
  constexpr double kNearlyOne = 1.0 - 1e-4;
  if (alpha == 1.0) return std::exp(-x);
  // Near 1 a pole comes too close to the path; interpolation in alpha has an error of 1e-8.
  if (alpha > kNearlyOne) {
    const double share = (alpha - kNearlyOne) / (1.0 - kNearlyOne);
    return (1.0 - share) * mittag_leffler_decay(kNearlyOne, x) + share * std::exp(-x);
  }
  const double ln_t = std::log(x) / alpha;
  const double cosine = std::cos(alpha * kPi);
  // Half-width of the strip in which the integrand is analytic and bounded: poles lie at
  // +-i pi (1 - alpha), growth begins at +-i alpha pi/2.
  const double strip = std::min(kPi * (1.0 - alpha), 0.5 * alpha * kPi);
  const double step = 2.0 * kPi * strip / 37.0;  // exp(-37) = 1e-16
  constexpr double kReach = 38.0;
  const auto count = static_cast<long>(std::ceil(kReach / step));
  double sum = 0.0;
  for (long k = -count; k <= count; ++k) {
    const double v = step * static_cast<double>(k);
    const double ln_rate = ln_t + v / alpha;
    if (ln_rate > 6.7) break;  // exp(-800)
    sum += std::exp(-std::exp(ln_rate)) / (2.0 * std::cosh(v) + 2.0 * cosine);
  }
  return std::sin(alpha * kPi) / (alpha * kPi) * step * sum;
}

}  // namespace viscard
