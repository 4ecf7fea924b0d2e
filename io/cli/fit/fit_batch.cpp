#include "io/cli/fit/fit_batch.h"

#include "io/basics/parallel.h"
#include "io/cli/words/progress.h"

#include <cstddef>
#include <mutex>

namespace viscard {

std::vector<FittedFile> fit_files(const std::vector<std::string>& files, const FitWords& words,
                                  Streams& streams) {
  std::vector<FittedFile> fitted(files.size());
  std::size_t n_done = 0;
  std::mutex drawing;
  Progress progress(streams, "fit");
  const auto show = [&](const std::string& file) {
    const std::lock_guard lock(drawing);
    progress.show(static_cast<double>(++n_done) / static_cast<double>(files.size()), file);
  };
  for_each_in_parallel(files.size(), [&](std::size_t i) {
    fitted[i] = fit_file(files[i], words);
    show(files[i]);
  });
  return fitted;
}

}  // namespace viscard
