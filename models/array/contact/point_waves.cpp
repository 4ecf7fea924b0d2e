#include "models/array/contact/point_waves.h"

#include <cmath>
#include <numbers>

namespace viscard {

Eigen::MatrixXd unit_waves(int angles) {
  Eigen::MatrixXd waves(angles, angles);
  for (int column = 0; column < angles; ++column) {
    const int m = (column + 1) / 2;
    const bool is_sine = column % 2 == 0 && column > 0;
    const bool is_single = m == 0 || 2 * m == angles;
    for (int a = 0; a < angles; ++a) {
      const double phase = m * 2.0 * std::numbers::pi * a / angles;
      waves(a, column) = (is_sine ? std::sin(phase) : std::cos(phase)) *
                         std::sqrt((is_single ? 1.0 : 2.0) / angles);
    }
  }
  return waves;
}

}  // namespace viscard
