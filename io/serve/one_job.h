#pragma once

#include "io/serve/api_error.h"

#include <atomic>
#include <mutex>
#include <string>
#include <utility>

namespace viscard {

// At most one piece of heavy work at a time: a run, a move by hand, a check of the rig or a fit. Both devices serve
// one program, and a fit beside a run could make this computer too late to watch the force.
class OneJob {
 public:
  // Throws ApiError 409 while there is another job, and once the program ends.
  void begin(std::string what) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (is_closing_) throw ApiError(409, "closing", "viscard serve is ending; start it again");
    if (!what_.empty()) {
      throw ApiError(409, "busy", "first " + what_ + " must end; then try again");
    }
    what_ = std::move(what);
  }
  void end() {
    const std::lock_guard<std::mutex> lock(mutex_);
    what_.clear();
  }
  // No job begins any more.
  void close() {
    const std::lock_guard<std::mutex> lock(mutex_);
    is_closing_ = true;
  }
  const std::atomic<bool>& is_closing() const { return is_closing_; }
  // "a run of 01_a", "a check of the rig" ...; empty without a job.
  std::string what() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return what_;
  }

 private:
  mutable std::mutex mutex_;
  std::string what_;
  std::atomic<bool> is_closing_{false};
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
