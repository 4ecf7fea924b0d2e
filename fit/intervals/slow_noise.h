#pragma once

#include "fit/curves/spectral_model.h"
#include "fit/samples/noise_model.h"

#include <string>

namespace viscard {

// Corrections of intervals for noise that is slow compared with the record.
struct SlowNoise {
  double widening = 1.0;  // of the covariance
  // If the noise is doubtful: every variance is at least this times that for white noise (batch
  // means).
  double batch_inflation = 1.0;
  // Nothing, or a sentence for the flag slow-noise. It is set if the inflation is above 5 and the
  // autocorrelation of the noise reaches 8 % of the record or fewer than 50 independent values
  // remain, or if means of samples scatter more than the autoregression implies.
  std::string doubt;
};

// The n/inflation independent values of a record lose one for each parameter, and so few of them
// determine their own variance only with the error of Student's t: the covariance is widened by both.
// With a doubt, intervals are at least as wide as the means of a fortieth, a twentieth and a tenth of
// the record imply (batch means).
//   variance: of one sample.
SlowNoise slow_noise(const SpectralModel& model, const SpectralState& state, double variance,
                     const Autoregression& noise);

// "the noise of the record has a memory of 12 % of it, or 8.1 independent values". memory: over the
// length of the record.
std::string memory_text(double memory, double independent);

// The covariance after both steps. white: the covariance for white noise of the same variance.
Eigen::MatrixXd widened(const Eigen::MatrixXd& covariance, const Eigen::MatrixXd& white,
                        const SlowNoise& slow);

}  // namespace viscard
