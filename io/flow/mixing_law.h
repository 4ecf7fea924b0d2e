#pragma once

#include "io/report/report_input.h"

#include <optional>
#include <string>
#include <vector>

namespace viscard {

// E0 over mixing ratio for the report: from the joint file among the inputs or, without one, fitted
// to E0 of the specimens if there are at least four at two or more ratios. Nothing otherwise.
std::optional<MixingLaw> mixing_law_of(const std::vector<std::string>& files,
                                       const std::vector<SpecimenReport>& specimens);

}  // namespace viscard
