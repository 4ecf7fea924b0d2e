#pragma once

#include "fit/assembly/assemble_result.h"
#include "fit/curves/spectral_model.h"
#include "fit/intervals/fit_result.h"
#include "fit/samples/fit_data.h"

namespace viscard {

// Standard uncertainty, relative, of the load cell's gain where the punch touched, from what the
// record itself shows: the gain changes by creep_N_m_s/stiffness per second under load, and has
// been free to do so since the first reading, when it was last known to be that of the calibration.
// The rate counts with its own standard error; sign and time course before contact are unknown, so
// rate times time is taken as a standard deviation (JCGM 100:2008, 4.3). 0 where the model has no
// creep.
double gain_drift_relative_u(const SpectralModel& model, const SpectralFit& fit,
                             const IndentationData& data);

// Adds an uncertainty that all moduli share, and no time or ratio of moduli, to their errors,
// covariance and intervals, in quadrature.
void add_common_uncertainty(double relative_u, FitResult& result);

}  // namespace viscard
