#pragma once

#include "io/report/report_html.h"
#include "io/report/report_input.h"

#include <filesystem>
#include <string>
#include <vector>

namespace viscard {

struct RenderedReport {
  std::string html;  // one self-contained page: no script, no external resource, pictures inline
  std::vector<ReportPicture> pictures;
};

// The same input gives the same bytes. Throws std::invalid_argument if there is no specimen, one
// has neither fit nor material, or moduli and stiffnesses meet; std::runtime_error if gnuplot is
// not installed or fails.
RenderedReport render_report(const ReportInput& input);
std::string html_from_report(const ReportInput& input);

// Writes the page whole or not at all (io/atomic_file.h).
void write_report(const ReportInput& input, const std::filesystem::path& path, bool overwrite);

}  // namespace viscard
