#pragma once

#include "io/plots/plot.h"
#include "io/report/report_estimates.h"
#include "io/report/report_input.h"
#include "io/report/report_run.h"

#include <optional>
#include <vector>

namespace viscard {

// The figures of the page. Each function returns nothing if its data are missing.

// E(t) of all specimens, absolute and relative to E0, with 95 % bands and the truth if it is known.
std::optional<Plot> relaxation_plot(const ReportInput& input,
                                    const std::vector<SpecimenEstimates>& estimates);

// E0 over mixing ratio with the interval of the fit and the wider one that includes the systematic
// part, and the law of a joint fit. Needs two different ratios.
std::optional<Plot> ratio_plot(const ReportInput& input,
                               const std::vector<SpecimenEstimates>& estimates);

// g_i over tau_i, each with its interval.
std::optional<Plot> spectrum_plot(const ReportInput& input,
                                  const std::vector<SpecimenEstimates>& estimates);

// Relaxation and creep of the pillar relative to their first value, from the solver and exact, and
// the relative error.
std::optional<Plot> pillar_plot(const ReportInput& input,
                                const std::vector<SpecimenEstimates>& estimates);

// Output of the load cell and depth (or stage position) of one run over time.
std::optional<Plot> run_plot(const RunSeries& series);

// Data with fit, and residuals divided by their standard deviation, over the logarithm of the time
// since each motion began.
std::optional<Plot> fit_plot(const FitResult& fit);

}  // namespace viscard
