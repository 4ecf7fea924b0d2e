#pragma once

#include "io/basics/parallel.h"
#include "rig/run/run_control.h"

#include <pybind11/pybind11.h>

#include <atomic>
#include <condition_variable>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace viscard::python {

// Long work runs in a thread of its own without the GIL. The thread that called waits, lets other
// Python threads run, notices Ctrl-C and calls the callbacks, so that they need no lock.
class Job {
 public:
  // For the working thread. Throws Interrupted once somebody wants the work to end.
  void report(double fraction, const std::string& step);
  void add(const RunReading& reading);

  const std::atomic<bool>& stop() const { return stop_; }
  const std::atomic<bool>& stop_at_once() const { return stop_at_once_; }

 private:
  friend class JobRunner;
  struct News {
    std::optional<std::pair<double, std::string>> progress;
    std::vector<RunReading> readings;
  };
  std::atomic<bool> stop_{false}, stop_at_once_{false};
  std::mutex mutex_;
  std::condition_variable changed_;
  News news_;
  bool is_done_ = false;
  std::exception_ptr error_;
};

// Python functions that a job calls; None: not called.
struct Listeners {
  pybind11::object progress = pybind11::none();  // (fraction, step)
  pybind11::object sample = pybind11::none();    // (time_s, force_N, depth_m); False ends the run
  // After Ctrl-C, or an exception of a callback, a simulation is left to end by itself at its next
  // progress report; a rig must stop before anybody goes on.
  bool must_end = false;
};

// Runs the work, rethrows its exception, and throws error_already_set after Ctrl-C or an exception of
// a callback.
void run_job(const std::shared_ptr<Job>& job, std::function<void()> work,
             const Listeners& listeners);

// Threads that are still at work although nobody waits for them.
int jobs_left();

// The value of work(job), computed in the background. The work owns its input.
template <typename Work>
auto in_background(const Listeners& listeners, Work work) {
  using Result = decltype(work(std::declval<Job&>()));
  const auto job = std::make_shared<Job>();
  const auto result = std::make_shared<std::optional<Result>>();
  run_job(
      job, [job, result, work = std::move(work)]() mutable { result->emplace(work(*job)); },
      listeners);
  return std::move(**result);
}

}  // namespace viscard::python
