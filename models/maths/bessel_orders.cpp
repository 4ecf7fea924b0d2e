#include "models/maths/bessel_orders.h"

#include <cmath>

namespace viscard {

void bessel_orders(double x, Eigen::Ref<Eigen::VectorXd> values) {
  values[0] = ::j0(x);
  values[1] = ::j1(x);
  for (Eigen::Index m = 2; m < values.size(); ++m) {
    const double order = static_cast<double>(m);
    values[m] = x > order ? 2.0 * (order - 1.0) / x * values[m - 1] - values[m - 2]
                          : ::jn(static_cast<int>(m), x);
  }
}

double disc_mean_of_wave(double kR) {
  return kR < 1e-8 ? 1.0 : 2.0 * ::j1(kR) / kR;
}

}  // namespace viscard
