#pragma once

#include "fit/intervals/fit_result.h"
#include "fit/samples/fit_data.h"

namespace viscard {

// Prony series from a creep compliance after a stress step. The retardation spectrum
//   J(t) = J_g + sum J_j (1 - exp(-t/lambda_j)) [+ t/eta with options.is_liquid]
// is fitted and converted exactly to the relaxation series
// (models/material/retardation_spectrum.h). terms and intervals are those of the relaxation series;
// rss and noise are those of the compliance. Throws as fit_relaxation() does, and
// std::runtime_error if the record shows no instantaneous compliance (E0 would be infinite).
FitResult fit_creep(const CreepData& data, const FitOptions& options = {});

}  // namespace viscard
