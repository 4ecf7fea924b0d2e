#include "models/maths/chebyshev_panel.h"

#include <cmath>
#include <numbers>

namespace viscard {

double chebyshev_point(int i, int count) {
  return -std::cos(std::numbers::pi * (i + 0.5) / count);
}

Eigen::RowVectorXd chebyshev_weights(double x, int count) {
  Eigen::RowVectorXd weights(count);
  for (int i = 0; i < count; ++i) {
    const double distance = x - chebyshev_point(i, count);
    if (distance == 0.0) return Eigen::RowVectorXd::Unit(count, i);
    weights[i] =
        (i % 2 == 0 ? 1.0 : -1.0) * std::sin(std::numbers::pi * (i + 0.5) / count) / distance;
  }
  return weights / weights.sum();
}

}  // namespace viscard
