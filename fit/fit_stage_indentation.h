#pragma once

#include "fit/intervals/fit_result.h"
#include "fit/samples/fit_data.h"
#include "models/material/prony_series.h"

namespace viscard {

// fit_indentation() for data whose depth follows from stage moves.
FitResult fit_stage_indentation(const IndentationData& data, const FitOptions& options);

// Removes a spring in series from a relaxation series (both in N/m). Compliances in series add,
// J_specimen = J_stage - 1/k, and the conversion from relaxation to retardation and back is exact.
// Throws std::runtime_error if the spring is softer than the whole.
PronySeries specimen_series(const PronySeries& stage_series_N_m, double frame_stiffness_N_m);

}  // namespace viscard
