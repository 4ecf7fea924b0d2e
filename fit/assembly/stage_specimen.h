#pragma once

#include "fit/assembly/spectral_fit.h"
#include "fit/samples/fit_data.h"
#include "models/material/prony_series.h"

namespace viscard {

// What the fit of a captured run (fit_stage_indentation) and the planning of one share: the
// specimen's own moduli from the parameters of a StageModel.

// Removes a spring in series from a relaxation series (both in N/m). Compliances in series add,
// J_specimen = J_stage - 1/k, and the conversion from relaxation to retardation and back is exact.
// Throws std::runtime_error if the spring is softer than the whole.
PronySeries specimen_series(const PronySeries& stage_series_N_m, double frame_stiffness_N_m);

// A specimen and a frame spring in series, as the stage sees them (N/m): the inverse of
// specimen_series(). frame_stiffness_N_m: 0: rigid.
PronySeries stage_series(const PronySeries& specimen_series_N_m, double frame_stiffness_N_m);

// The specimen's series for states of this model: without the frame, and in Pa if the data have a
// contact. The model must outlive the returned function.
SeriesFromState specimen_series_of(const SpectralModel& model, const IndentationData& data,
                                   bool is_liquid);

}  // namespace viscard
