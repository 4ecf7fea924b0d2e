#pragma once

#include "io/report/report_html.h"
#include "io/report/report_input.h"

#include <string>
#include <vector>

namespace viscard {

struct RenderedReport {
  std::string html;  // one self-contained page: no script, no external resource, pictures inline
  std::vector<ReportPicture> pictures;
};

// Makes the page. The same input gives the same bytes. Throws std::invalid_argument if there is no
// specimen, a specimen has neither fit nor material, or some specimens have moduli and others
// stiffnesses; std::runtime_error if gnuplot is not installed or fails.
RenderedReport render_report(const ReportInput& input);

}  // namespace viscard
