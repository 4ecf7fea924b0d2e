#pragma once

#include "fit/assembly/spectral_fit.h"
#include "fit/curves/joint_model.h"
#include "fit/intervals/grouped_covariance.h"
#include "models/material/prony_series.h"

#include <vector>

namespace viscard {

// Fits the path of orders of several tests together and chooses one, as fit_spectrum() does for one
// test. groups: the noise of each test; the sums of squares count its n/inflation independent values.
// Creep is linearised about `start`, and then about the last answer until that stays the same.
// Covariance and variance of the result are those of the groups.
SpectralFit fit_joint_spectrum(JointModel& model, const std::vector<NoiseGroup>& groups,
                               const std::vector<int>& blocks, const PronySeries& start,
                               const FitOptions& options);

}  // namespace viscard
