#pragma once

#include <Eigen/Core>

namespace viscard {

// J_0 to J_(values.size() - 1) at x >= 0, at least two of them. Upward recursion is stable for orders below x:
// Abramowitz & Stegun (1964), 9.12.
void bessel_orders(double x, Eigen::Ref<Eigen::VectorXd> values);

// Mean of a wave of wave number k over a disc of radius R around its crest, by k R: 2 J_1(x)/x.
double disc_mean_of_wave(double kR);

}  // namespace viscard
