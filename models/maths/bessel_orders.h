#pragma once

#include <Eigen/Core>

namespace viscard {

// J_0 to J_(values.size() - 1) at x >= 0, at least two of them. Upward recursion is stable for orders below x:
// Abramowitz & Stegun (1964), 9.12.
void bessel_orders(double x, Eigen::Ref<Eigen::VectorXd> values);

}  // namespace viscard
