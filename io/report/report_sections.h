#pragma once

#include "io/report/report.h"
#include "io/report/report_estimates.h"
#include "io/report/report_html.h"

#include <vector>

namespace viscard {

// The sections of the page, in order. A section whose data are missing is omitted with its heading.
void add_summary(Page& page, const ReportInput& input,
                 const std::vector<SpecimenEstimates>& estimates);
void add_recovery(Page& page, const ReportInput& input,
                  const std::vector<SpecimenEstimates>& estimates);
void add_pillar(Page& page, const ReportInput& input,
                const std::vector<SpecimenEstimates>& estimates);
void add_specimen(Page& page, const SpecimenReport& specimen, const SpecimenEstimates& estimates);
void add_cards(Page& page, const ReportInput& input,
               const std::vector<SpecimenEstimates>& estimates);
// The methods used for this page, in a few sentences with their sources.
void add_methods(Page& page, const ReportInput& input);
void add_provenance(Page& page, const ReportInput& input,
                    const std::vector<SpecimenEstimates>& estimates);

// Figures and table of the tests that were fitted together; nothing for a fit of one test.
void add_tests(Page& page, const FitResult& fit);

// What the figure of data and fit shows. is_relative: the noise is relative to each value.
std::string fit_caption(const FitResult& fit, bool is_relative);

}  // namespace viscard
