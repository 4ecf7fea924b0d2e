#pragma once

#include <Eigen/Core>

#include <vector>

namespace viscard {

// Noise with memory, e_t = sum phi_k e_{t-k} + white: the autoregression that the residuals of a
// fit ask for. Order by BIC, so that white noise comes out as order 0. Coefficients from the
// autocovariances by Levinson's recursion (Brockwell & Davis, Time Series (1991), sect. 8.2).
struct Autoregression {
  std::vector<double> phi;  // empty: white

  // Factor by which memory widens the variance of a mean over many samples: spectral density at
  // frequency 0 over variance. At least 1.
  double inflation() const;
  // Autocorrelation at lags 0, 1, ... until it has died away.
  std::vector<double> autocorrelation() const;
};
Autoregression autoregression(const Eigen::VectorXd& series);

// Sums of the autocorrelation over pairs of stretches of samples, each pair in constant time.
class PairSums {
 public:
  explicit PairSums(const Autoregression& noise);
  // sum over i < p, j < q of rho(distance + j - i): two stretches of p and q samples whose first
  // samples are `distance` >= 0 apart (0: the same stretch).
  double over(double p, double q, double distance) const;
  // Stretches further apart than this do not know of each other.
  double reach() const { return static_cast<double>(twice_summed_.size()); }

 private:
  double at(double lag) const;
  std::vector<double> twice_summed_;  // T(m), whose second difference is rho(m)
};

// Scatter of a series with trends of any kind in it: from third differences, median-based so that a
// spike does not count.
double sigma_from_differences(const std::vector<double>& values);

}  // namespace viscard
