#pragma once

#include "io/flow/specimen_reports.h"

namespace viscard {

// Tells the files of a report apart: laws of rubber become request.rubbers, words such as "creep=b.csv" request.tests.
// Throws std::invalid_argument for no file, for a law of rubber alone or a test at large strain,
// and for a single test that states its kind.
void sort_inputs(ReportRequest& request);

// What the page shows: reads and fits all files, runs the pillar and writes the cards in memory, as read_specimens() does.
ReportInput read_report(const ReportRequest& request, const std::string& title,
                        const FlowProgress& progress);

// One line for each result on the page that is not to be trusted.
std::vector<std::string> defects_of(const ReportInput& input);

}  // namespace viscard
