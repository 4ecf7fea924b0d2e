#pragma once

#include <Eigen/Core>

#include <vector>

namespace viscard {

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
