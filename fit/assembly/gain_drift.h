#pragma once

#include "fit/assembly/assemble_result.h"
#include "fit/curves/spectral_model.h"
#include "fit/intervals/fit_result.h"
#include "fit/samples/fit_data.h"

namespace viscard {

// Relative standard uncertainty of the load cell's gain at first contact, from the record itself.
// The gain changes by creep_N_m_s/stiffness per second under load, and may have done so since the
// first reading, when it equalled the calibrated gain. The rate is increased by its own standard
// error. Sign and time course before contact are unknown, so rate times time is used as a standard
// deviation (JCGM 100:2008, 4.3). 0 if the model has no creep.
double gain_drift_relative_u(const SpectralModel& model, const SpectralFit& fit,
                             const IndentationData& data);

// Adds in quadrature a relative uncertainty common to all moduli to their errors, covariance and
// intervals. Times and ratios of moduli do not change.
void add_common_uncertainty(double relative_u, FitResult& result);

}  // namespace viscard
