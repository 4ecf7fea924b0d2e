#pragma once

#include "io/plots/plot.h"
#include "io/report/report_estimates.h"
#include "io/report/report_html.h"

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

// One row for each ratio with at least two specimens: the mean of E0 and of 1 - E_inf/E0, their
// standard deviation between specimens, and the median standard error of a single fit. Empty if no
// ratio is repeated.
HtmlTable spread_table(const std::vector<SpecimenEstimates>& estimates);

// Profile likelihoods: rise of the sum of squares over E_inf and over each relaxation time, one
// panel each. Nothing if the fit has none.
std::optional<Plot> profile_plot(const FitResult& fit);

}  // namespace viscard
