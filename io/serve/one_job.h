#pragma once

#include <mutex>
#include <string>
#include <utility>

namespace viscard {

// At most one piece of heavy work at a time: a run, a move by hand, a check of the rig or a fit. Both devices serve
// one program, and a fit beside a run could make this computer too late to watch the force.
class OneJob {
 public:
  // False if there is a job already.
  bool try_begin(std::string what) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!what_.empty()) return false;
    what_ = std::move(what);
    return true;
  }
  void end() {
    const std::lock_guard<std::mutex> lock(mutex_);
    what_.clear();
  }
  // "a run of 01_a", "a check of the rig" ...; empty without a job.
  std::string what() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return what_;
  }

 private:
  mutable std::mutex mutex_;
  std::string what_;
};

// Ends a job at the end of a scope.
class JobEnd {
 public:
  explicit JobEnd(OneJob& job) : job_(job) {}
  ~JobEnd() { job_.end(); }
  JobEnd(const JobEnd&) = delete;
  JobEnd& operator=(const JobEnd&) = delete;

 private:
  OneJob& job_;
};

}  // namespace viscard
