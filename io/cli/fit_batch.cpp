#include "io/cli/fit_batch.h"

#include "io/cli/progress.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>

namespace viscard {

std::vector<FittedFile> fit_files(const std::vector<std::string>& files, const FitWords& words,
                                  Streams& streams) {
  std::vector<FittedFile> fitted(files.size());
  std::vector<std::exception_ptr> failures(files.size());
  std::atomic<std::size_t> next{0};
  std::atomic<std::size_t> done{0};
  std::mutex drawing;
  Progress progress(streams, "fit");
  const auto work = [&] {
    for (std::size_t i = next++; i < files.size(); i = next++) {
      try {
        fitted[i] = fit_file(files[i], words);
      } catch (...) {
        failures[i] = std::current_exception();
      }
      const std::lock_guard lock(drawing);
      progress.show(static_cast<double>(++done) / static_cast<double>(files.size()), files[i]);
    }
  };
  std::vector<std::thread> threads;
  const std::size_t cores = std::max(1U, std::thread::hardware_concurrency());
  for (std::size_t i = 1; i < std::min(cores, files.size()); ++i) threads.emplace_back(work);
  work();
  for (std::thread& thread : threads) thread.join();
  progress.clear();
  for (const std::exception_ptr& failure : failures) {
    if (failure) std::rethrow_exception(failure);
  }
  return fitted;
}

}  // namespace viscard
