#pragma once

#include "io/report/report.h"

#include <optional>
#include <string>
#include <vector>

namespace viscard {

// E0 over mixing ratio for the report: that of a joint file among the inputs, or else fitted to the
// specimens' own E0 when there are four or more at two ratios or more. Nothing otherwise.
std::optional<MixingLaw> mixing_law_of(const std::vector<std::string>& files,
                                       const std::vector<SpecimenReport>& specimens);

}  // namespace viscard
