#pragma once

#include <Eigen/Core>
#include <vector>

namespace viscard {

// Integrated autocorrelation 1 + 2 sum rho_k of a series, summed until the lag reaches six times the
// sum so far (Sokal, Monte Carlo Methods in Statistical Mechanics (1996), sect. 3). At least 1: the
// factor by which correlation widens the variance of a mean.
double integrated_autocorrelation(const Eigen::VectorXd& series);

// Scatter of a series with trends of any kind in it: from third differences, median-based so that a
// spike does not count.
double sigma_from_differences(const std::vector<double>& values);

}  // namespace viscard
