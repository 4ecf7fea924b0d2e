#pragma once

#include "fit/curves/spectral_model.h"

#include <Eigen/Core>

#include <string>

namespace viscard {

// Noise that grows with the value, for example of a creep compliance that rises a hundredfold. The
// fit weights all samples alike, so the covariance for equal noise is too small for parameters that
// large values determine (a viscosity) and too large for the others.
struct LevelNoise {
  // Standard deviation of each row over the root mean square of all samples; empty for equal noise.
  Eigen::VectorXd row_scale;
  std::string note;  // for the flag noise-grows; empty for equal noise
};

// Tests whether the squared residuals grow with the square of the fitted value (Koenker, J. Econometrics
// 17 (1981) 107, at p = 1e-3), and if so fits their variance a + b value^2, a and b not negative.
//   inflation: of the variance of means by the memory of the noise; so many rows count as one.
LevelNoise level_noise(const SpectralModel& model, const SpectralState& state, double inflation);

}  // namespace viscard
