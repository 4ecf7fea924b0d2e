#include "io/python/job.h"

#include "io/basics/inputs.h"
#include "models/maths/may_stop.h"

#include <chrono>
#include <thread>

namespace viscard::python {
namespace {

namespace py = pybind11;

constexpr std::chrono::milliseconds kBetweenLooks{50};  // at Ctrl-C
constexpr std::chrono::milliseconds kPatience{200};     // with work that shall end

std::atomic<int> n_left{0};

}  // namespace

void Job::report(double fraction, const std::string& step) {
  if (stop_) throw Interrupted();
  const std::lock_guard lock(mutex_);
  news_.progress = {fraction, step};
  changed_.notify_one();
}

void Job::add(const RunReading& reading) {
  const std::lock_guard lock(mutex_);
  news_.readings.push_back(reading);
  changed_.notify_one();
}

// The side of a job that waits.
class JobRunner {
 public:
  JobRunner(std::shared_ptr<Job> job, std::function<void()> work, const Listeners& listeners)
      : job_(std::move(job)), listeners_(listeners) {
    ++n_left;
    thread_ = std::thread([job = job_, work = recorded_as_here(std::move(work)),
                           is_rig = listeners.must_end]() mutable {
      std::exception_ptr error;
      const StopCheck stop([&] {
        if (job->stop_ && !is_rig) throw Interrupted();  // a rig has its own way to stop
      });
      try {
        work();
      } catch (...) {
        error = std::current_exception();
      }
      work = nullptr;  // destroys its values while somebody may still wait
      const std::lock_guard lock(job->mutex_);
      job->error_ = error;
      job->is_done_ = true;
      --n_left;
      job->changed_.notify_one();
    });
  }

  void run() {
    try {
      for (bool is_done = false; !is_done;) {
        Job::News news;
        is_done = wait(kBetweenLooks, news);
        look_for_signals();
        deliver(news);
      }
    } catch (...) {
      end();
      throw;
    }
    thread_.join();
    if (job_->error_) std::rethrow_exception(job_->error_);
  }

 private:
  // Waits for news without the GIL; true once the work has ended.
  bool wait(std::chrono::milliseconds at_most, Job::News& news) {
    const py::gil_scoped_release others_may_run;
    std::unique_lock lock(job_->mutex_);
    job_->changed_.wait_for(lock, at_most, [&] {
      return job_->is_done_ || job_->news_.progress || !job_->news_.readings.empty();
    });
    news = std::exchange(job_->news_, {});
    return job_->is_done_;
  }

  static void look_for_signals() {
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  }

  void deliver(const Job::News& news) {
    if (news.progress && !listeners_.progress.is_none()) {
      listeners_.progress(news.progress->first, news.progress->second);
    }
    if (listeners_.sample.is_none()) return;
    for (const RunReading& one : news.readings) {
      const py::object answer = listeners_.sample(one.time_s, one.force_N, one.depth_m);
      if (answer.is(py::bool_(false))) job_->stop_ = true;
    }
  }

  // Ends the work early. A second Ctrl-C stops the stage of a rig at once.
  void end() {
    job_->stop_ = true;
    const auto start = std::chrono::steady_clock::now();
    Job::News ignored;
    while (!wait(kBetweenLooks, ignored)) {
      if (!listeners_.must_end && std::chrono::steady_clock::now() - start > kPatience) {
        thread_.detach();
        return;
      }
      if (PyErr_CheckSignals() != 0) {
        PyErr_Clear();
        job_->stop_at_once_ = true;
      }
    }
    thread_.join();
  }

  std::shared_ptr<Job> job_;
  const Listeners& listeners_;
  std::thread thread_;
};

void run_job(const std::shared_ptr<Job>& job, std::function<void()> work,
             const Listeners& listeners) {
  JobRunner(job, std::move(work), listeners).run();
}

int jobs_left() {
  return n_left;
}

}  // namespace viscard::python
