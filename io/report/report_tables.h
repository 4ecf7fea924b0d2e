#pragma once

#include "io/report/report.h"
#include "io/report/report_estimates.h"
#include "io/report/report_html.h"

#include <vector>

namespace viscard {

// The tables of the page. Values have their 95 % intervals in brackets.

// One row per specimen: E0, E_inf, number of terms, systematic part, two-point modulus.
HtmlTable summary_table(const std::vector<SpecimenEstimates>& estimates);

// One row per ratio with at least two specimens: the mean of E0 and of 1 - E_inf/E0, their standard
// deviation between specimens (each the mean of its touches), and the median standard error of a fit.
// Empty if there is no such ratio.
HtmlTable spread_table(const std::vector<SpecimenEstimates>& estimates);

// The scatter between touches, specimens and ratios, one row per level. Empty without scatter.
HtmlTable levels_table(const std::vector<Scatter>& scatter);

// One row per term.
HtmlTable terms_table(const std::vector<SpecimenEstimates>& estimates);

// Truth, estimate, interval, difference, and whether the interval contains the truth.
HtmlTable recovery_table(const ReportInput& input, const std::vector<SpecimenEstimates>& estimates);

// Counts over all parameters of all specimens with a known truth.
struct RecoveryCount {
  int n = 0, n_inside = 0, n_inside_with_systematic = 0, n_not_resolved = 0;
  double largest_E0_error = 0.0;  // relative
};
RecoveryCount count_recovery(const ReportInput& input,
                             const std::vector<SpecimenEstimates>& estimates);

// The orders tried, with the chosen one marked.
HtmlTable orders_table(const FitResult& fit);

}  // namespace viscard
