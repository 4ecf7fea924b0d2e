#pragma once

#include "io/report/report.h"
#include "io/report/report_estimates.h"
#include "io/report/report_html.h"

#include <string>
#include <vector>

namespace viscard {

// How the modulus at rest of a law of rubber compares with that of a linear test.
struct ModulusComparison {
  std::size_t specimen = 0, rubber = 0;  // indices
  std::string which;                     // "E0", "E_inf", or "E0 to E_inf" of an elastic law
  Estimate linear, large_strain;         // of an elastic law the linear one spans E_inf to E0
  bool overlaps = true;                  // of the 95 % intervals
};

// All pairs of a linear specimen and a law. A law with terms is compared at once and after all
// relaxation. Of an elastic law the rate is not known: its modulus must lie between both of the linear
// test. The linear intervals include the systematic part, added in quadrature. Stiffnesses without
// geometry are not compared.
std::vector<ModulusComparison> compare_rubbers(const ReportInput& input,
                                               const std::vector<SpecimenEstimates>& estimates);

// One sentence for each comparison whose intervals do not overlap.
std::vector<std::string> rubber_disagreements(const ReportInput& input);

// Linear tests and laws of rubber side by side, and where they disagree; nothing without a law.
void add_rubbers(Page& page, const ReportInput& input,
                 const std::vector<SpecimenEstimates>& estimates);

}  // namespace viscard
