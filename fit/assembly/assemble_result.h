#pragma once

#include "fit/assembly/spectral_fit.h"
#include "fit/intervals/fit_result.h"

#include <vector>

namespace viscard {

// blocks: number of each row's block for cross-validation (log_time_blocks).
SpectralFit fit_spectrum(const SpectralModel& model, const std::vector<int>& blocks,
                         const FitOptions& options);

// Fills everything of a result that follows from the fit alone: parameters, intervals (with the
// doubt about the order, profiles and bootstrap as the options ask), orders, noise.
void fill_result(const SpectralModel& model, const SpectralFit& fit,
                 const SeriesFromState& series_from_state, FitResult& result);

// The series where the state's parameters are the material's own: E_inf first (a liquid has none),
// then the moduli. The model must outlive it.
SeriesFromState relaxation_series_of(const SpectralModel& model, bool is_liquid);

// Block numbers for cross-validation: contiguous runs of rows that end when they cover a tenth of a
// decade of the time since `zero_s`, but not before `shortest` rows nor after a fiftieth of all.
std::vector<int> log_time_blocks(const std::vector<double>& time_s, double zero_s,
                                 std::size_t shortest);

}  // namespace viscard
