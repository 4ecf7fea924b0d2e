#include "io/basics/parallel.h"
#include "io/flow/fit_file.h"

#include <cstddef>
#include <mutex>
#include <utility>

namespace viscard {

std::vector<FileOutcome> fit_each_file(const std::vector<std::string>& files,
                                       const FitRequest& request, const FlowProgress& progress) {
  std::vector<FileOutcome> outcomes(files.size());
  std::size_t n_done = 0;
  std::mutex reporting;
  const auto report = [&](const std::string& file) {
    const std::lock_guard lock(reporting);
    ++n_done;
    if (progress) progress(static_cast<double>(n_done) / static_cast<double>(files.size()), file);
  };
  for_each_in_parallel(files.size(), [&](std::size_t i) {
    outcomes[i].path = files[i];
    try {
      outcomes[i].fitted = fit_file(files[i], request);
    } catch (const std::exception&) {
      outcomes[i].error = std::current_exception();
    }
    report(files[i]);
  });
  return outcomes;
}

std::vector<FittedFile> fit_files(const std::vector<std::string>& files, const FitRequest& request,
                                  const FlowProgress& progress) {
  std::vector<FittedFile> fitted;
  for (FileOutcome& outcome : fit_each_file(files, request, progress)) {
    if (outcome.error) std::rethrow_exception(outcome.error);
    fitted.push_back(std::move(*outcome.fitted));
  }
  return fitted;
}

}  // namespace viscard
