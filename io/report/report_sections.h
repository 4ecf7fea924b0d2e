#pragma once

#include "io/report/report_estimates.h"
#include "io/report/report_html.h"
#include "io/report/report_input.h"

#include <vector>

namespace viscard {

// The sections of the page, in order. Each adds nothing, not even its heading, when its data are
// missing.
void add_summary(Page& page, const ReportInput& input,
                 const std::vector<SpecimenEstimates>& estimates);
void add_recovery(Page& page, const ReportInput& input,
                  const std::vector<SpecimenEstimates>& estimates);
void add_pillar(Page& page, const ReportInput& input,
                const std::vector<SpecimenEstimates>& estimates);
void add_specimen(Page& page, const SpecimenReport& specimen, const SpecimenEstimates& estimates);
void add_cards(Page& page, const ReportInput& input,
               const std::vector<SpecimenEstimates>& estimates);
// How the numbers were found, in a few sentences with their sources; only what this page needs.
void add_methods(Page& page, const ReportInput& input);
void add_provenance(Page& page, const ReportInput& input,
                    const std::vector<SpecimenEstimates>& estimates);

}  // namespace viscard
