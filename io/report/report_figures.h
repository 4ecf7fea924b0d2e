#pragma once

#include "io/plots/plot.h"
#include "io/report/report.h"
#include "io/report/report_estimates.h"
#include "io/report/report_run.h"

#include <optional>
#include <string>
#include <vector>

namespace viscard {

// Colour and legend entry of each specimen. Repeated specimens of a mixing ratio have one colour
// and one entry, "10 : 1 (3 specimens)".
struct SpecimenStyle {
  Ink ink = Ink::kBlue;
  std::string label;  // empty if another specimen of this ratio has the entry
};
std::vector<SpecimenStyle> styles_of(const std::vector<SpecimenEstimates>& estimates);

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

// Profile likelihoods: rise of the sum of squares over E_inf and over each relaxation time, one
// panel each. Nothing if the fit has none.
std::optional<Plot> profile_plot(const FitResult& fit);

}  // namespace viscard
