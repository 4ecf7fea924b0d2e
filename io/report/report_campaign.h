#pragma once

#include "io/plots/plot.h"
#include "io/report/report_estimates.h"
#include "io/report/report_html.h"

#include <optional>
#include <string>
#include <vector>

namespace viscard {

// What a page says of several specimens together.

// Colour and legend entry of each specimen. Repeated specimens of a mixing ratio share the ratio's
// colour and one entry, "10 : 1 (3 specimens)".
struct SpecimenStyle {
  Ink ink = Ink::kBlue;
  std::string label;  // empty: another specimen of this ratio has it
};
std::vector<SpecimenStyle> styles_of(const std::vector<SpecimenEstimates>& estimates);

// One row for each ratio with at least two specimens: mean of E0 and of 1 - E_inf/E0, the standard
// deviation between specimens, and the median standard error of a single fit beside it. Empty where
// no ratio is repeated.
HtmlTable spread_table(const std::vector<SpecimenEstimates>& estimates);

// Rise of the sum of squares over E_inf and every relaxation time, one panel each.
std::optional<Plot> profile_plot(const FitResult& fit);

}  // namespace viscard
