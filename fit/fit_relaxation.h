#pragma once

#include "fit/intervals/fit_result.h"
#include "fit/samples/fit_data.h"

namespace viscard {

// Prony series from a relaxation modulus, a stress after a step, or a stress with its strain
// history (fit/README.md, eq. 2 and 5). Example:
//   RelaxationData data{.time_s = t, .value = E};
//   FitResult fit = fit_relaxation(data);
//   fit.E0_Pa, fit.terms[0].tau_s_95.low, fit.orders ...
// Throws std::invalid_argument if the columns differ in length, and std::runtime_error if the data
// cannot be fitted; the message names the cause and the place.
FitResult fit_relaxation(const RelaxationData& data, const FitOptions& options = {});

}  // namespace viscard
