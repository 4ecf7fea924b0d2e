#include "io/basics/atomic_file.h"
#include "io/flow/fit_file.h"
#include "io/flow/specimen_reports.h"

#include <filesystem>

namespace viscard {

SpecimenReport specimen_of_tests(const ReportRequest& request, const FlowProgress& progress) {
  const FittedFile fitted = fit_tests(request.tests, {}, progress);
  SpecimenReport report;
  report.fit = fitted.result;
  report.specimen = fitted.specimen;
  if (report.specimen.id.empty()) {
    report.specimen.id = std::filesystem::path(request.tests.front().path).stem().string();
  }
  for (const TestFile& test : request.tests) {
    report.files.push_back({test.path, sha256_of_file(test.path)});
  }
  if (!fitted.result.is_stiffness) {
    report.material = material_from_fitted(
        fitted, {.command = request.command, .created_at = request.created_at});
  }
  return report;
}

}  // namespace viscard
