#pragma once

#include "io/flow/specimen_reports.h"

namespace viscard {

// Tells the files of a report apart: laws of rubber become request.rubbers, words such as "creep=b.csv" request.tests.
// Throws std::invalid_argument for no file, for a law of rubber alone or a test at large strain,
// for a single test that states its kind, and for truth files that are not one for each capture or table.
void sort_inputs(ReportRequest& request);

// What the page shows: reads and fits all files, runs the pillar and writes the cards in memory, as read_specimens() does.
ReportInput read_report(const ReportRequest& request, const std::string& title,
                        const FlowProgress& progress);

// Writes each picture of the page as a file into the folder, which is made if need be. Returns their paths.
std::vector<std::string> write_report_pictures(const RenderedReport& report,
                                               const std::string& folder, bool overwrite);

// One line for each result on the page that is not to be trusted.
std::vector<std::string> defects_of(const ReportInput& input);

}  // namespace viscard
