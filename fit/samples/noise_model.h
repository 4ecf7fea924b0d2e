#pragma once

#include <Eigen/Core>

#include <vector>

namespace viscard {

// Autocorrelated noise, e_t = sum phi_k e_{t-k} + white: an autoregression fitted to the residuals
// of a fit. White noise gets order 0 (BIC of orders up to 12, Levinson's recursion). Other noise gets
// up to 80 coefficients by Burg's recursion, their number by AICc (Brockwell & Davis, Introduction
// to Time Series and Forecasting (2016), sect. 5.1.2 and 5.5.2).
struct Autoregression {
  std::vector<double> phi;  // empty: white noise
  // Means of up to some tens of samples, with an autoregression of their own, show a slower part:
  // factor on the inflation that phi implies, and its memory in samples.
  double slow_factor = 1.0, slow_memory = 0.0;

  // Factor by which autocorrelation increases the variance of a mean over many samples: spectral
  // density at frequency 0 over the variance. At least 1.
  double inflation() const;
  // First lag from which on the autocorrelation stays below 0.05.
  double memory() const;
  // Autocorrelation at lags 0, 1, ... until it has decayed.
  std::vector<double> autocorrelation() const;
};
Autoregression autoregression(const Eigen::VectorXd& series);

// Sums of the autocorrelation over pairs of stretches of samples, in constant time per pair.
class PairSums {
 public:
  explicit PairSums(const Autoregression& noise);
  // sum over i < p, j < q of rho(distance + j - i): two stretches of p and q samples whose first
  // samples are `distance` >= 0 apart (0: the same stretch).
  double over(double p, double q, double distance) const;
  // Stretches further apart than this are uncorrelated.
  double reach() const { return static_cast<double>(twice_summed_.size()); }

 private:
  double at(double lag) const;
  std::vector<double> twice_summed_;  // T(m), whose second difference is rho(m)
};

// Standard deviation of the noise of a series with a smooth trend: from third differences, and by
// their median, so that spikes do not count.
double sigma_from_differences(const std::vector<double>& values);

// Standard deviations of the readings of a captured run: while the stage rests, while it moves (its
// steps shake the force), and the contribution of the scatter of the time stamps to each reading.
struct StageNoise {
  double resting_N = 1.0;
  double moving_N = 1.0;
  double stamp_s = 0.0;         // standard deviation of a time stamp; 0: not detected
  Eigen::VectorXd of_stamps_N;  // of each reading; empty: none
};

// Residual of a first fit at each reading, and the fitted force there.
struct StageResidual {
  std::vector<double> time_s;  // ascending
  std::vector<bool> is_moving, is_out_of_contact;
  Eigen::VectorXd fitted_N, residual_N;
};

// A time stamp that is off by d records F(t + d) instead of F(t). That is no error at rest and an
// error of d times the force rate in motion: tens of times the noise in a quick unloading. The
// scatter of the stamps is the one that maximises the likelihood of the residuals (normal; the
// variances of shaking and stamps add). It is used only if it raises the log likelihood by six, the
// same evidence that a term needs (Kass & Raftery, J. Am. Stat. Assoc. 90 (1995) 773).
StageNoise stage_noise(const StageResidual& left);

}  // namespace viscard
