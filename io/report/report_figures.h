#pragma once

#include "io/plots/plot.h"
#include "io/report/report_estimates.h"
#include "io/report/report_input.h"
#include "io/report/report_run.h"

#include <optional>
#include <vector>

namespace viscard {

// The pictures of the page. Each returns nothing when its data are missing.

// E(t) of all specimens and the same relative to E0, with 95 % bands and, where known, the truth.
std::optional<Plot> relaxation_plot(const ReportInput& input,
                                    const std::vector<SpecimenEstimates>& estimates);

// E0 over mixing ratio: random interval, and that with the systematic part; the law of a joint fit.
// Needs two different ratios.
std::optional<Plot> ratio_plot(const ReportInput& input,
                               const std::vector<SpecimenEstimates>& estimates);

// g_i over tau_i with the intervals of both.
std::optional<Plot> spectrum_plot(const ReportInput& input,
                                  const std::vector<SpecimenEstimates>& estimates);

// Relaxation and creep of the pillar relative to their first value, solver on exact, and the error.
std::optional<Plot> pillar_plot(const ReportInput& input,
                                const std::vector<SpecimenEstimates>& estimates);

// Volts and depth (or stage position) of one run.
std::optional<Plot> run_plot(const RunSeries& series);

// Data with fit, and residuals over their standard deviation, on logarithmic time from each motion.
std::optional<Plot> fit_plot(const FitResult& fit);

}  // namespace viscard
