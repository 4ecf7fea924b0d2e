#pragma once

#include "fit/intervals/fit_result.h"
#include "fit/samples/fit_data.h"

namespace viscard {

// Prony series from a creep compliance after a stress step: the retardation spectrum
// J(t) = J_g + sum J_j (1 - exp(-t/lambda_j)) [+ t/eta with options.is_liquid] is fitted and turned
// into the relaxation series exactly (models/retardation_spectrum.h). terms and intervals are those
// of the relaxation series; rss and noise are of the compliance. Throws as fit_relaxation() does,
// and std::runtime_error when the record shows no instantaneous compliance (E0 would be infinite).
FitResult fit_creep(const CreepData& data, const FitOptions& options = {});

}  // namespace viscard
