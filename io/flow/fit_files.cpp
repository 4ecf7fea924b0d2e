#include "io/basics/parallel.h"
#include "io/flow/fit_file.h"

#include <cstddef>
#include <mutex>

namespace viscard {

std::vector<FittedFile> fit_files(const std::vector<std::string>& files, const FitRequest& request,
                                  const FlowProgress& progress) {
  std::vector<FittedFile> fitted(files.size());
  std::size_t n_done = 0;
  std::mutex reporting;
  const auto report = [&](const std::string& file) {
    const std::lock_guard lock(reporting);
    ++n_done;
    if (progress) progress(static_cast<double>(n_done) / static_cast<double>(files.size()), file);
  };
  for_each_in_parallel(files.size(), [&](std::size_t i) {
    fitted[i] = fit_file(files[i], request);
    report(files[i]);
  });
  return fitted;
}

}  // namespace viscard
