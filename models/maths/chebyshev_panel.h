#pragma once

#include <Eigen/Core>

namespace viscard {

// Chebyshev points of the first kind over (-1, 1), i from 0 to count - 1, ascending.
double chebyshev_point(int i, int count);
// Weights of the values there in the polynomial through them, at x: Berrut & Trefethen, SIAM Rev. 46 (2004) 501.
Eigen::RowVectorXd chebyshev_weights(double x, int count);

}  // namespace viscard
