#pragma once

#include "fit/assembly/spectral_fit.h"
#include "fit/samples/fit_data.h"

namespace viscard {

// Replaces the state of the fit by the best one that satisfies the constraints: least squares in
// all parameters within bounds (trust region of Ceres), started from the free optimum and from the
// fixed times. The covariance is that of the free parameters; a parameter that ends on a bound
// counts as fixed. Nuisances and the common columns other than the first (E_inf) stay free. Throws
// std::invalid_argument if the constraints leave no possible material: E_inf < 0, terms out of
// order, a time that the record cannot show. Adds the note constraints-strained if the constraints
// fit the data visibly worse than the free fit does, or contradicts-data if that makes the result
// untrustworthy.
void constrain(const SpectralModel& model, const FitOptions& options, SpectralFit& fit);

}  // namespace viscard
