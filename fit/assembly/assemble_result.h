#pragma once

#include "fit/assembly/spectral_fit.h"
#include "fit/curves/history_model.h"
#include "fit/curves/step_model.h"
#include "fit/intervals/fit_result.h"
#include "fit/intervals/kept_rows.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace viscard {

// Fits the path of orders and chooses one. blocks: log_time_blocks() of the rows.
SpectralFit fit_spectrum(const SpectralModel& model, const std::vector<int>& blocks,
                         const FitOptions& options);

// Keeps the rows of a test, and the noise that its fit found, in the result.
void keep(KeptRows rows, const SpectralFit& fit, FitResult& result);

// Fits the path of orders and chooses one; a requested order is taken instead. blocks:
// log_time_blocks() of the rows. inflation: of the noise; none: by the residual of the largest order.
void search_orders(const SpectralModel& model, const std::vector<int>& blocks,
                   std::optional<double> inflation, SpectralFit& fit);

// Weighted sum of squares over all samples.
double full_rss(const SpectralModel& model, const SpectralState& state);

// Fills what follows from the fit alone: parameters, intervals (with the uncertainty of the order,
// and with profiles and bootstrap if the options ask for them), orders, noise.
void fill_result(const SpectralModel& model, const SpectralFit& fit,
                 const SeriesFromState& series_from_state, FitResult& result);

// Fills FitResult::curves with the bin averages of a step fit.
void fill_step_curves(const StepModel& model, const SpectralFit& fit, const std::string& unit,
                      FitResult& result);

// The same with the averages of a history. motion_start_s: when the input moved; rows before the first of these
// times are left out. Empty: all rows.
void fill_history_curves(const HistoryModel& model, const SpectralFit& fit, const std::string& unit,
                         std::vector<double> motion_start_s, FitResult& result);

// Adds the flag noise-grows if the rows of the model are weighed by a noise that grows with the value.
void note_weights(const StepModel& model, const ReadingNoise& noise, const std::string& unit,
                  FitResult& result);

// The series of a model whose parameters are the material's own: E_inf first (none for a liquid),
// then the moduli. The model must outlive the returned function.
SeriesFromState relaxation_series_of(const SpectralModel& model, bool is_liquid);

// Block indices for cross-validation: runs of rows. A run ends when it covers a tenth of a decade
// of the time since `zero_s` and has `shortest` rows, or when it has a fiftieth of all rows.
std::vector<int> log_time_blocks(std::span<const double> time_s, double zero_s,
                                 std::size_t shortest);

}  // namespace viscard
