#pragma once

#include <Eigen/Core>

#include <vector>

namespace viscard {

// Standard deviations of the readings of a captured run: while the stage rests, while it moves (its
// steps shake it), and what scatter of the time stamps adds to each.
struct StageNoise {
  double resting_N = 1.0;
  double moving_N = 1.0;
  double stamp_s = 0.0;         // standard deviation of a stamp; 0: not seen
  Eigen::VectorXd of_stamps_N;  // of each reading; empty: none
};

// What a first fit leaves of each reading, and what it says of the force there.
struct StageResidual {
  std::vector<double> time_s;  // ascending
  std::vector<bool> is_moving, is_out_of_contact;
  Eigen::VectorXd fitted_N, residual_N;
};

// A stamp that is off by d makes of a reading F(t + d) where F(t) was meant: nothing at rest, and
// an error of d times the rate in motion, some tens of times the noise in a quick unloading. The
// scatter of stamps is the one that makes the residuals likeliest (normal, variances of shaking and
// stamps added); it counts only where it raises the logarithm of the likelihood by six, as much as
// a term needs (Kass & Raftery, J. Am. Stat. Assoc. 90 (1995) 773).
StageNoise stage_noise(const StageResidual& left);

}  // namespace viscard
