#pragma once

#include "fit/curves/spectral_model.h"

namespace viscard {

// A few Gauss-Newton steps in all parameters together, for the last digits. Stops before a step
// that would leave the bounds or increase the residual.
SpectralState polish(const SpectralModel& model, const SpectralState& start);

struct PolishedState {
  SpectralState state;
  double rss = 0.0;  // weighted, over all samples
};

// The same to the optimum of all samples: averaging neglects a little of the data, so the optimum of
// the averages is near it only. The steps have the slope of all samples and the curvature of the
// averages. Rows that are samples are left as they are.
PolishedState polish_samples(const SpectralModel& model, const SpectralState& start);

}  // namespace viscard
